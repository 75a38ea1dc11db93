// Shows what is hovered over or chosen in another colour.

export class Highlight {
  constructor(mechanism) {
    this.mechanism = mechanism;
    this.changed = new Map();  // mesh: its own material
  }

  // The meshes for which `matches(userData)` holds; none without it. True if anything changed.
  set(matches) {
    let changed = this.changed.size > 0;
    for (const [mesh, material] of this.changed) mesh.material = material;
    this.changed.clear();
    if (matches) {
      this.mechanism.root.traverse((object) => {
        if (!object.isMesh || !matches(object.userData)) return;
        this.changed.set(object, object.material);
        object.material = this.mechanism.materials.for_mesh('highlight', object);
        changed = true;
      });
    }
    return changed;
  }
}

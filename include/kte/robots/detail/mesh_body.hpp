#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/math/rigid_body.hpp>
#include <kte/robots/detail/triangle_mesh.hpp>

namespace kte::detail {

/// The mass distribution of a mesh.
///   exact   the volume enclosed by the faces
///   legacy  pyramids from the centroid of the faces, all counted as positive, as MuJoCo does by default: too large for
///           most concave meshes, but defined for surfaces that are open
///   convex  the convex hull of the vertices
///   shell   the faces, with the same mass per area everywhere
enum class mesh_inertia { legacy, exact, convex, shell };

/// Volume, centre of mass and moments of a mesh of density 1.
struct mesh_moments {
  double amount = 0;  ///< volume, m^3; for a shell the area, m^2
  vec3<> centre{};    ///< of mass, m
  sym3<> second{};    ///< S, the sum of (2) about the centre, in the axes of the mesh, m^5 or m^4
  sym3<> inertia{};   ///< inertia (3) about the centre
};

/// Volume, centre of mass and inertia of a mesh. Face i and an apex p form a pyramid of volume V_i; a, b, c are the
/// vertices of the face relative to p, and s = a + b + c:
///
///   V_i = a . (b x c)/6,   integral of r dV = V_i s/4                        (1)
///   integral of r r^T dV = V_i/20 (s s^T + a a^T + b b^T + c c^T)            (2)
///   I = tr(S) 1 - S,   S the sum of (2)                                      (3)
///
/// with r relative to p. The first apex is the centroid of the faces, weighted by area, and (1) gives the centre of
/// mass. A second pass with the apex there gives the volume by (1) and the inertia by (3): neither suffers from
/// cancellation, however far the mesh is from its origin. For a closed surface the sums over all faces are exact for
/// any p. For an open one they equal those of MuJoCo (`open_edge` of mesh_edges.hpp tells which it is).
///   legacy  uses |V_i|
///   shell   uses triangles of area A_i instead of pyramids: A_i s/3 in (1), A_i/12 instead of V_i/20 in (2)
/// A mesh without faces stands for its convex hull. Throws `bad_argument` if the volume or area is zero or negative
/// (faces that point inwards, except with legacy), if an index is out of range, or if a number is not finite or too
/// large.
mesh_moments moments_of(const triangle_mesh& mesh, mesh_inertia kind);

/// Whether the faces of a closed surface point inwards: the volume (1) is negative.
bool points_inwards(const triangle_mesh& mesh);

/// The rigid body of a mesh with this density, kg/m^3, or kg/m^2 for a shell, in the axes of the mesh.
rigid_body<> mesh_body(const triangle_mesh& mesh, mesh_inertia kind, double density);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/mesh_edges.hpp>
#  include <kte/robots/detail/mesh_hull.hpp>

#  include <algorithm>
#  include <cmath>

namespace kte::detail {

inline sym3<> scaled(double k, const sym3<>& m) { return {k * m.xx, k * m.xy, k * m.xz, k * m.yy, k * m.yz, k * m.zz}; }

/// The sums of (1) and (2) about a point.
struct mesh_sums {
  double amount = 0;
  vec3<> first{};
  sym3<> second{};
};
inline mesh_sums sums_about(const vec3<>& apex, const triangle_mesh& mesh, mesh_inertia kind) {
  const bool shell = kind == mesh_inertia::shell;
  const auto square = [](const vec3<>& v) {
    return sym3<>{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
  };
  mesh_sums sums;
  for (const auto& [i, j, k] : mesh.faces) {
    const vec3<> a = mesh.vertices[i] - apex, b = mesh.vertices[j] - apex, c = mesh.vertices[k] - apex, s = a + b + c;
    const vec3<> n = cross(b - a, c - a);
    const double volume = dot(a, n) / 6;
    const double amount = shell                          ? std::hypot(n.x, n.y, n.z) / 2
                          : kind == mesh_inertia::legacy ? std::abs(volume)
                                                         : volume;
    sums.amount += amount;
    sums.first = sums.first + (shell ? amount / 3 : amount / 4) * s;  // (1)
    sums.second = sums.second + scaled(shell ? amount / 12 : amount / 20,
                                       (square(s) + square(a)) + (square(b) + square(c)));  // (2)
  }
  return sums;
}

[[noreturn]] inline void fail_large_mesh() {
  raise<bad_argument>("kte: the numbers of the mesh are too large for its mass properties");
}
/// Throws unless the volume exceeds the rounding error of a flat mesh.
inline void check_volume(double volume, double least) {
  if (!std::isfinite(volume) || !std::isfinite(least)) fail_large_mesh();
  if (!(std::abs(volume) > least)) raise<bad_argument>("kte: the mesh has no volume");
  if (volume < 0)
    raise<bad_argument>("kte: the mesh has a volume of " + number(volume) + " m^3: its faces point inwards");
}

KTE_FUNCTION mesh_moments moments_of(const triangle_mesh& mesh, mesh_inertia kind) {
  check_mesh(mesh);
  const bool shell = kind == mesh_inertia::shell;
  if (kind == mesh_inertia::convex) return moments_of(convex_hull(mesh.vertices), mesh_inertia::exact);
  if (mesh.faces.empty()) return moments_of(convex_hull(mesh.vertices), kind);
  const auto start = mesh.vertices[mesh.faces[0][0]];
  const auto surface = sums_about(start, mesh, mesh_inertia::shell);
  if (!(surface.amount > 0)) raise<bad_argument>("kte: the faces of the mesh have no area");
  double size = 0;
  for (const auto& v : mesh.vertices) size = (std::max)({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const double tiny = 1e-300;  // its inverse is finite
  const double least = shell ? tiny : (std::max)(tiny, 1e-15 * surface.amount * size);

  vec3<> centre = start + (1 / surface.amount) * surface.first;
  if (!shell) {
    const auto rough = sums_about(centre, mesh, kind);
    check_volume(rough.amount, least);
    centre = centre + (1 / rough.amount) * rough.first;
  }
  const auto sums = sums_about(centre, mesh, kind);
  check_volume(sums.amount, least);
  const auto& s = sums.second;
  const mesh_moments m{sums.amount, centre, s, {s.yy + s.zz, -s.xy, -s.xz, s.zz + s.xx, -s.yz, s.xx + s.yy}};  // (3)
  if (!std::isfinite(m.amount + dot(m.centre, m.centre) + trace(m.inertia))) fail_large_mesh();
  return m;
}

KTE_FUNCTION bool points_inwards(const triangle_mesh& mesh) {
  check_mesh(mesh);
  return !mesh.faces.empty() && sums_about(mesh.vertices[mesh.faces[0][0]], mesh, mesh_inertia::exact).amount < 0;
}

KTE_FUNCTION rigid_body<> mesh_body(const triangle_mesh& mesh, mesh_inertia kind, double density) {
  if (!(density >= 0 && std::isfinite(density)))
    raise<bad_argument>("kte: the density of a mesh must be finite and not negative, got " + number(density));
  const auto m = moments_of(mesh, kind);
  return {density * m.amount, m.centre, scaled(density, m.inertia)};
}

}  // namespace kte::detail
#endif

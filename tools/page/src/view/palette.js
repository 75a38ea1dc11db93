// Colours of the 3D view, by role, on light and on dark ground.

const light = {
  background: 0xf6f7f9, sky: 0xffffff, ground: 0xc9ced6, grid: 0x9aa4b2, shadow: 0.16,
  link: 0x64748b, joint: 0x2f6fde, joint_dark: 0x1e4fa8, range: 0x2f6fde, needle: 0xd9480f, fixed: 0x94a3b8,
  body: 0xd6a54b, mass: 0x8a5a12, spring: 0x2b9348, damper: 0x64748b, damper_rod: 0x334155, torsion: 0x2b9348, beam: 0xb5651d,
  bushing: 0x0f766e, motor: 0xc2255c, limit: 0xd9480f, friction: 0x7c5c3e, loop: 0x7b3fbf, contact: 0xd6336c, other: 0x7b8794,
  visual: 0xaab4c2, plane: 0x8a97a8, collision: 0xd6336c, highlight: 0xf59f00, ghost: 0xe8590c, trail: 0x0b7285, pull: 0xd6336c,
  weight: 0x7048e8, load: 0xe03131, reaction: 0x1c7ed6,
};
const dark = {
  background: 0x14171c, sky: 0xffffff, ground: 0x3a4250, grid: 0x566173, shadow: 0.35,
  link: 0x9fb0c6, joint: 0x5b9bff, joint_dark: 0x2f6fde, range: 0x5b9bff, needle: 0xff922b, fixed: 0x7b8aa0,
  body: 0xe0b45f, mass: 0xf0cd8c, spring: 0x51cf66, damper: 0x9fb0c6, damper_rod: 0xd5dde8, torsion: 0x51cf66, beam: 0xe8985a,
  bushing: 0x3bc9bd, motor: 0xf06595, limit: 0xff922b, friction: 0xc9a27e, loop: 0xb197fc, contact: 0xff6b9d, other: 0x9aa6b6,
  visual: 0x9aa7b8, plane: 0x6b7a8f, collision: 0xff6b9d, highlight: 0xffd43b, ghost: 0xff922b, trail: 0x3bc9db, pull: 0xff6b9d,
  weight: 0xb197fc, load: 0xff6b6b, reaction: 0x74c0fc,
};
export const palettes = { light, dark };

// Of roles that let see through.
export const opacities = { body: 0.42, plane: 0.16, range: 0.28, ghost: 0.38, collision: 0.3, highlight: 0.85 };

// Of frames' axes x, y, z, the same on both grounds.
export const axes = [0xe03131, 0x2f9e44, 0x1c7ed6];

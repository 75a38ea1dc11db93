#pragma once

namespace kte {

/// Stiffness of the section of a beam in the plane: area A, second moment I, moduli E and G of the material.
struct planar_beam_section {
  double EA;      ///< N
  double EI;      ///< N m^2
  double GA = 0;  ///< shear stiffness k G A of Timoshenko's beam, N; 0: rigid in shear, as Bernoulli's
};
/// Stiffness of the section of a beam in space: y and z are principal axes of the section, x is along the beam.
struct beam_section {
  double EA;        ///< N
  double EI_y;      ///< bending about y, in the plane x-z, N m^2
  double EI_z;      ///< bending about z, in the plane x-y, N m^2
  double GJ;        ///< torsion, N m^2
  double GA_y = 0;  ///< shear along y, N; 0: rigid in shear
  double GA_z = 0;  ///< shear along z, N; 0: rigid in shear
};

namespace detail {

constexpr beam_section in_space(const planar_beam_section& s) { return {s.EA, 0, s.EI, 0, s.GA, 0}; }
constexpr const beam_section& in_space(const beam_section& s) { return s; }

/// The stiffness of a beam of length L in bending about one axis. `r`: by the rotation r between its ends. `bent`: the
/// part of a transverse deflection that is bending; the rest is shear, if no other load acts. `give`: the shear per
/// moment that bends the beam.
///
///   r: EI/L,   bent: 1/(1 + f),   give: 1/((1 + f) GA L),   f = 12 EI/(GA L^2)
template <class S>
struct bending_stiffness {
  S r, bent, give;
  constexpr bending_stiffness(double EI, double GA, const S& L) {
    const S f = GA > 0 ? S(S(12) * S(EI) / (S(GA) * L * L)) : S(0);
    r = S(EI) / L, bent = S(1) / (S(1) + f), give = GA > 0 ? S(bent / (S(GA) * L)) : S(0);
  }
};
template <class S>
struct beam_stiffness {
  bending_stiffness<S> y, z;
  S twist;
  constexpr beam_stiffness(const beam_section& k, double rest_length)
      : y(k.EI_y, k.GA_z, S(rest_length)), z(k.EI_z, k.GA_y, S(rest_length)), twist(S(k.GJ) / S(rest_length)) {}
};

}  // namespace detail

}  // namespace kte

#pragma once

#include <kte/dynamics/batch.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/static.hpp>

#include <cstring>
#include <span>

#include "eval/frame_named.hpp"
#include "eval/static_library.hpp"

/// The functions of a library for one robot.
namespace evaluate {

template <class Call>
void caught(const Call& call, library_failure& f) {
  using enum library_failure::kind;
  const auto failed = [&f](library_failure::kind what, const char* text) {
    f.what = what;
    std::strncpy(f.text, text, sizeof f.text - 1);
  };
  try {
    call();
  } catch (const kte::bad_argument& e) {
    failed(bad_argument, e.what());
  } catch (const kte::singular_mass_matrix& e) {
    failed(singular_mass_matrix, e.what());
  } catch (const std::exception& e) {
    failed(other, e.what());
  }
}

template <const auto& Chain>
struct library_of {
  using chain_type = std::remove_cvref_t<decltype(Chain)>;
  static constexpr std::size_t n = std::size_t{chain_type::dofs};
  static constexpr std::size_t nq = kte::batch::detail::nq<chain_type>;
  using position = std::span<const double, nq>;
  using motion = std::span<const double, n>;
  static position q(const double* const* in) { return position(in[0], nq); }
  static motion v(const double* const* in) { return motion(in[1], n); }
  static motion third(const double* const* in) { return motion(in[2], n); }

  template <class X>
  static void put_vector(const X& x, double* out) {
    for (std::size_t i = 0; i < n; ++i) out[i] = static_cast<double>(x[static_cast<decltype(x.size())>(i)]);
  }
  template <class M>
  static void put_matrix(const M& m, double* out) {
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index j = 0; j < m.cols(); ++j) *out++ = m(i, j);
  }
  template <class V>
  static void put_xyz(const V& x, double* out) {
    out[0] = x.x, out[1] = x.y, out[2] = x.z;
  }

  static void inverse_dynamics(const double* const* in, double* const* out, library_failure& f) {
    caught([&] { put_vector(kte::inverse_dynamics(Chain, q(in), v(in), third(in)), out[0]); }, f);
  }
  static void forward_dynamics(const double* const* in, double* const* out, library_failure& f) {
    caught([&] { put_vector(kte::forward_dynamics(Chain, q(in), v(in), third(in)), out[0]); }, f);
  }
  static void mass_matrix(const double* const* in, double* const* out, library_failure& f) {
    caught([&] { put_matrix(kte::mass_matrix(Chain, q(in)), out[0]); }, f);
  }
  static void mass_matrix_inverse(const double* const* in, double* const* out, library_failure& f) {
    caught([&] { put_matrix(kte::mass_matrix_inverse(Chain, q(in)), out[0]); }, f);
  }
  static void nonlinear_effects(const double* const* in, double* const* out, library_failure& f) {
    caught([&] { put_vector(kte::nonlinear_effects(Chain, q(in), v(in)), out[0]); }, f);
  }
  static void gravity_forces(const double* const* in, double* const* out, library_failure& f) {
    caught([&] { put_vector(kte::gravity_forces(Chain, q(in)), out[0]); }, f);
  }
  static void inverse_dynamics_derivatives(const double* const* in, double* const* out, library_failure& f) {
    caught(
        [&] {
          const auto d = kte::inverse_dynamics_derivatives(Chain, q(in), v(in), third(in));
          put_vector(d.tau, out[0]), put_matrix(d.by_q, out[1]), put_matrix(d.by_v, out[2]), put_matrix(d.by_a, out[3]);
        },
        f);
  }
  static void forward_dynamics_derivatives(const double* const* in, double* const* out, library_failure& f) {
    caught(
        [&] {
          const auto d = kte::forward_dynamics_derivatives(Chain, q(in), v(in), third(in));
          put_vector(d.a, out[0]), put_matrix(d.by_q, out[1]), put_matrix(d.by_v, out[2]), put_matrix(d.by_tau, out[3]);
        },
        f);
  }
  static void energy(const double* const* in, double* const* out, library_failure& f) {
    caught(
        [&] {
          const auto e = kte::energy(Chain, q(in), v(in));
          *out[0] = e.kinetic, *out[1] = e.potential;
        },
        f);
  }
  template <kte::fixed_string Frame>
  static void forward_kinematics(const double* const* in, double* const* out, library_failure& f) {
    caught(
        [&] {
          const auto pose = kte::forward_kinematics(Chain, q(in), frame_named<Frame>(Chain));
          put_xyz(pose.position, out[0]);
          const auto r = kte::matrix(pose.rotation);
          put_xyz(r.x, out[1]), put_xyz(r.y, out[1] + 3), put_xyz(r.z, out[1] + 6);
        },
        f);
  }
  template <kte::fixed_string Frame>
  static void jacobian(const double* const* in, double* const* out, library_failure& f) {
    caught([&] { put_matrix(kte::jacobian(Chain, q(in), frame_named<Frame>(Chain)), out[0]); }, f);
  }
  template <kte::fixed_string Frame>
  static void jacobian_in_world_axes(const double* const* in, double* const* out, library_failure& f) {
    caught([&] { put_matrix(kte::jacobian(Chain, q(in), frame_named<Frame>(Chain), kte::in_world_axes), out[0]); }, f);
  }

  // In packs.
  using numbers_in = std::span<const double>;
  using numbers_out = std::span<double>;
  static void inverse_dynamics_of_states(std::size_t k, const double* const* in, double* out, std::size_t threads,
                                         library_failure& f) {
    caught(
        [&] {
          kte::batch::inverse_dynamics(Chain, numbers_in(in[0], k * nq), numbers_in(in[1], k * n),
                                       numbers_in(in[2], k * n), numbers_out(out, k * n), kte::batch::threads(threads));
        },
        f);
  }
  static void forward_dynamics_of_states(std::size_t k, const double* const* in, double* out, std::size_t threads,
                                         library_failure& f) {
    caught(
        [&] {
          kte::batch::forward_dynamics(Chain, numbers_in(in[0], k * nq), numbers_in(in[1], k * n),
                                       numbers_in(in[2], k * n), numbers_out(out, k * n), kte::batch::threads(threads));
        },
        f);
  }
  static void mass_matrix_of_states(std::size_t k, const double* const* in, double* out, std::size_t threads,
                                    library_failure& f) {
    caught(
        [&] {
          kte::batch::mass_matrix(Chain, numbers_in(in[0], k * nq), numbers_out(out, k * n * n),
                                  kte::batch::threads(threads));
        },
        f);
  }

  static constexpr library_function functions[]{
      {"inverse_dynamics", nullptr, inverse_dynamics, inverse_dynamics_of_states},
      {"forward_dynamics", nullptr, forward_dynamics, forward_dynamics_of_states},
      {"mass_matrix", nullptr, mass_matrix, mass_matrix_of_states},
      {"mass_matrix_inverse", nullptr, mass_matrix_inverse, nullptr},
      {"nonlinear_effects", nullptr, nonlinear_effects, nullptr},
      {"gravity_forces", nullptr, gravity_forces, nullptr},
      {"inverse_dynamics_derivatives", nullptr, inverse_dynamics_derivatives, nullptr},
      {"forward_dynamics_derivatives", nullptr, forward_dynamics_derivatives, nullptr},
      {"energy", nullptr, energy, nullptr},
  };
};

}  // namespace evaluate

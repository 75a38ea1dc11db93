#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/momentum_rate.hpp>
#include <kte/dynamics/subtree_inertia.hpp>

#include "define.hpp"
#include "parts.hpp"

namespace kte_python {

using kte::runtime_chain;

namespace {
std::vector<shape> three_by_n(Py_ssize_t n) { return {{3, n}}; }
std::vector<shape> number_and_xyz(Py_ssize_t) { return {{}, {3}}; }
std::vector<shape> two_numbers(Py_ssize_t) { return {{}, {}}; }
std::vector<shape> body(Py_ssize_t) { return {{}, {3}, {3, 3}}; }
}  // namespace

void bind_momentum(py::module_& m) {
  define<1>(
      m,
      {"potential_energy",
       "potential_energy(chain, q, *, inputs=None, threads=None, errors=\"raise\")\n\nPotential energy of gravity "
       "and springs, J; that of gravity is zero with the centre of mass at the origin of the base.",
       a_number, 1},
      [](const runtime_chain& k, workspace& w, double* const* out) {
        *out[0] = kte::potential_energy(k, w.state, w.x[0]);
      });
  define<2>(m,
            {"kinetic_energy",
             "kinetic_energy(chain, q, v, *, inputs=None, threads=None, errors=\"raise\")\n\nKinetic energy, J.",
             a_number, 1},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              *out[0] = kte::kinetic_energy(k, w.state, w.x[0], w.x[1]);
            });
  define<2>(m,
            {"energy",
             "energy(chain, q, v, *, inputs=None, threads=None, errors=\"raise\")\n\n`.kinetic` and `.potential` "
             "energy, J.",
             two_numbers, 2, "Energy"},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              const auto e = kte::energy(k, w.state, w.x[0], w.x[1]);
              *out[0] = e.kinetic, *out[1] = e.potential;
            });
  define<1>(m,
            {"centre_of_mass",
             "centre_of_mass(chain, q, *, inputs=None, threads=None, errors=\"raise\")\n\n`.mass`, kg, and `.position` "
             "of the centre of mass, m, in axes of the base.",
             number_and_xyz, 1, "MassCentre"},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              const auto c = kte::centre_of_mass(k, w.state, w.x[0]);
              *out[0] = c.mass, write_xyz(c.position, out[1]);
            });
  define<2>(m,
            {"centre_of_mass_velocity",
             "centre_of_mass_velocity(chain, q, v, *, inputs=None, threads=None, errors=\"raise\")\n\nVelocity of the "
             "centre of mass, m/s, in axes of the base.",
             xyz, 1},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write_xyz(kte::centre_of_mass_velocity(k, w.state, w.x[0], w.x[1]), out[0]);
            });
  define<3>(m,
            {"centre_of_mass_acceleration",
             "centre_of_mass_acceleration(chain, q, v, a, *, inputs=None, threads=None, errors=\"raise\")\n\n"
             "Acceleration of the centre of mass, m/s^2, without gravity, in axes of the base.",
             xyz, 1},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write_xyz(kte::centre_of_mass_acceleration(k, w.state, w.x[0], w.x[1], w.x[2]), out[0]);
            });
  define<1>(m,
            {"centre_of_mass_jacobian",
             "centre_of_mass_jacobian(chain, q, *, inputs=None, threads=None, errors=\"raise\")\n\nJ, (3, nv): "
             "centre_of_mass_velocity = J v.",
             three_by_n, 2},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write(kte::centre_of_mass_jacobian(k, w.state, w.x[0]), out[0]);
            });
  define<2>(
      m,
      {"centroidal_momentum",
       "centroidal_momentum(chain, q, v, *, inputs=None, threads=None, errors=\"raise\")\n\n`.linear`, kg m/s, and "
       "`.angular` momentum about the centre of mass, kg m^2/s, in axes of the base.",
       two_xyz, 1, "LinearAngular"},
      [](const runtime_chain& k, workspace& w, double* const* out) {
        const auto h = kte::centroidal_momentum(k, w.state, w.x[0], w.x[1]);
        write_xyz(h.linear, out[0]), write_xyz(h.angular, out[1]);
      });
  define<3>(m,
            {"centroidal_momentum_rate",
             "centroidal_momentum_rate(chain, q, v, a, *, inputs=None, threads=None, errors=\"raise\")\n\nThe time "
             "derivative of the centroidal momentum: `.linear`, N, `.angular`, Nm.",
             two_xyz, 1, "LinearAngular"},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              const auto h = kte::centroidal_momentum_rate(k, w.state, w.x[0], w.x[1], w.x[2]);
              write_xyz(h.linear, out[0]), write_xyz(h.angular, out[1]);
            });
  define<1>(
      m,
      {"centroidal_momentum_matrix",
       "centroidal_momentum_matrix(chain, q, *, inputs=None, threads=None, errors=\"raise\")\n\nA, (6, nv), linear "
       "rows first: centroidal_momentum = A v.",
       six_by_n, 2},
      [](const runtime_chain& k, workspace& w, double* const* out) {
        write(kte::centroidal_momentum_matrix(k, w.state, w.x[0]), out[0]);
      });
  define_of_frame<1>(m,
                     {"subtree_inertia",
                      "subtree_inertia(chain, q, frame, *, threads=None, errors=\"raise\")\n\nThe bodies on a frame as "
                      "one body: `.mass`, kg, "
                      "`.moment`, kg m, and `.inertia`, (3, 3), kg m^2, about the origin of the frame in its axes.",
                      body, 2, "BodyInertia"},
                     [](const runtime_chain& k, workspace& w, const std::string& frame, double* const* out) {
                       const auto b = kte::subtree_inertia(k, w.state, w.x[0], frame);
                       *out[0] = b.mass, write_xyz(b.moment, out[1]);
                       const auto& i = b.inertia;
                       const double rows[]{i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz};
                       std::copy_n(rows, 9, out[2]);
                     });
}

}  // namespace kte_python

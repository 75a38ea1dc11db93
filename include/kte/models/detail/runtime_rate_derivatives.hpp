#pragma once

#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/runtime/duals.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/models/detail/rate_derivatives.hpp>
#include <kte/runtime_chain.hpp>

/// (J B) of models/detail/rate_derivatives.hpp for runtime chains. Templates, although for double only, so that they
/// are compiled only if they are called.
namespace kte::detail {

/// Seeds column j of (J B) as the direction of a state with derivatives: along q, v, z, u; accelerations along `a`.
template <std::same_as<double> S, class D, class Column>
void seed_direction(const runtime_chain& c, basic_derivative_state<D>& d, int j, std::size_t lane, const Column& a) {
  const topology& t = c.wiring();
  const int n = t.nv, nz = t.count(kind::internal);
  for (int i = 0; i < n; ++i) d.a[static_cast<std::size_t>(i)].derivative[lane] = a[i];
  if (j < n) {
    for (const freedom& f : d.freedoms())
      if (f.v <= j && j < f.v + nv_of(f.what)) displace(f, j - f.v, lane, std::span(d.q));
  } else if (j < 2 * n) {
    d.v[static_cast<std::size_t>(j - n)].derivative[lane] = S(1);
  } else if (j < 2 * n + nz) {
    d.template get<kind::internal>(j - 2 * n).z.derivative[lane] = S(1);
  } else {
    const int u = j - 2 * n - nz;
    for (const auto& signal : t.signals) {
      if (signal.u < 0 || u < signal.u || u >= signal.u + nu_of(signal.what)) continue;
      if (signal.what == kind::vector) {
        auto& x = d.template get<kind::vector>(signal.slot);
        (u == signal.u ? x.x : u == signal.u + 1 ? x.y : x.z).derivative[lane] = S(1);
      } else {
        d.template get<kind::input>(signal.slot).derivative[lane] = S(1);
      }
    }
  }
}

/// The angular derivative of a rotation R, in world axes: R' = [turned]x R.
template <class S, int N>
vec3<dual<S, N>> turning_of(const mat3<vec3<dual<S, N>>>& rotation) {
  vec3<dual<S, N>> turned{};
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(N); ++lane) {
    const auto rate = [lane](const vec3<dual<S, N>>& v) {
      return vec3<S>{v.x.derivative[lane], v.y.derivative[lane], v.z.derivative[lane]};
    };
    const auto value = [](const vec3<dual<S, N>>& v) { return vec3<S>{v.x.value, v.y.value, v.z.value}; };
    turned.x.derivative[lane] = dot(rate(rotation.z), value(rotation.y));
    turned.y.derivative[lane] = dot(rate(rotation.x), value(rotation.z));
    turned.z.derivative[lane] = dot(rate(rotation.y), value(rotation.x));
  }
  return turned;
}
/// Sets the bases, with derivatives if elements move them.
template <std::same_as<double> S, class D>
void place_bases(const runtime_chain& c, const basic_runtime_state<S>& s, basic_derivative_state<D>& d) {
  const auto& t = s.tree();
  tree::place_bases_in_duals(t.body_tree, s.work, d.work);
  for (std::size_t i = 0; i < t.plan.bases.size(); ++i) {
    const auto [k, index] = t.plan.bases[i];
    if (c.wiring().writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(index)] < 0) continue;
    const auto slot = static_cast<std::size_t>(t.slot_of_base[i]);
    with_frame(d, k, index, [&](auto& x) {
      const auto m = spatial(x);
      d.work.bodies[slot] = {as<D>(m.velocity), as<D>(m.ang_velocity), as<D>(m.acceleration),
                             as<D>(m.ang_acceleration)};
      d.work.world[slot].position = as<D>(m.position);
      d.work.world[slot].rotation = as<D>(matrix(m.rotation));
      d.work.joint_transforms[slot].turned = turning_of(d.work.world[slot].rotation);
    });
  }
}
/// doMotion with derivatives, of the elements with internal states and those on which they depend; call after inverse
/// dynamics.
template <class D>
void move_keepers(const runtime_chain& c, basic_derivative_state<D>& d) {
  const topology& t = c.wiring();
  std::vector<char> wanted(t.elements.size());
  for (const int keeper : t.keepers) wanted[static_cast<std::size_t>(keeper)] = 1;
  const auto each_read = [](const topology::connection& e, const auto& visit) {
    for (std::size_t p = 0; p < e.ports.size(); ++p)
      if (!e.ports[p].writes()) visit(e.ports[p].what, e.index[p]);
  };
  for (std::size_t e = wanted.size(); e-- > 0;) {
    if (!wanted[e]) continue;
    each_read(t.elements[e], [&](kind k, int i) {
      const int writer = t.writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
      if (writer >= 0 && !t.elements[static_cast<std::size_t>(writer)].rigid)
        wanted[static_cast<std::size_t>(writer)] = 1;
    });
  }
  for (std::size_t e = 0; e < wanted.size(); ++e) {
    if (!wanted[e]) continue;
    each_read(t.elements[e], [&](kind k, int i) {
      if (is_frame(k) && d.tree().body_tree.frame(k, i).slot >= 0) place_frame(d, k, i, true);
    });
    runtime_elements{c}.move(static_cast<int>(e), d);
  }
}

/// (J B) at the state, without external forces. Throws what `forward_dynamics_derivatives` throws.
template <std::same_as<double> S>
void derive_rates_by_inputs(const runtime_chain& c, basic_runtime_state<S>& s, runtime_matrix<S>& j) {
  const topology& t = c.wiring();
  const int n = t.nv, nz = t.count(kind::internal), columns = 2 * n + nz + t.nu;
  j.resize(2 * n + nz, columns);
  const forward_dynamics_result<S, Eigen::Dynamic> a = forward_dynamics_derivatives(c, s);
  const runtime_vector<S> v = velocities(s);
  put_rate_derivatives(s.freedoms(), v, a, j);
  if (columns == 2 * n) return;
  set_accelerations(s, a.a);
  auto& d = state_with_derivatives(c, s);
  constexpr int lanes = std::remove_reference_t<decltype(d)>::scalar::variables;
  const runtime_vector<S> none = runtime_vector<S>::Zero(n);
  const auto evaluate = [&](int first, int last, const auto& along) {
    take_given(s, d);
    for (int k = first; k < last; ++k) seed_direction<S>(c, d, k, static_cast<std::size_t>(k - first), along(k));
    place_in_world(s);
    put_coordinates(d);
    bring_up_to_date(runtime_elements{c}, d);
    place_bases(c, s, d);
    // Rotations are displaced along their directions, numbers along themselves.
    inverse_dynamics_in_duals(runtime_elements{c}, s, d, directions{vector_of::q, first});
  };
  const auto each_group = [&](int begin, const auto& visit) {
    for (int first = begin; first < columns; first += lanes) visit(first, (std::min)(first + lanes, columns));
  };
  each_group(2 * n, [&](int first, int last) {
    evaluate(
        first, last, [&](int) -> const auto& { return none; });
    for (int k = first; k < last; ++k) {
      runtime_vector<S> need(n);
      for (int i = 0; i < n; ++i)
        need[i] = d.forces[static_cast<std::size_t>(i)].derivative[static_cast<std::size_t>(k - first)];
      j.col(k).segment(n, n) = -(a.by_tau * need);
    }
  });
  if (nz == 0) return;
  each_group(0, [&](int first, int last) {
    evaluate(first, last, [&](int k) { return j.col(k).segment(n, n).eval(); });
    move_keepers(c, d);
    for (int k = first; k < last; ++k)
      for (int i = 0; i < nz; ++i)
        j(2 * n + i, k) = d.template get<kind::internal>(i).z_dot.derivative[static_cast<std::size_t>(k - first)];
  });
}

#ifdef KTE_EXTERN
KTE_EXTERN template void derive_rates_by_inputs(const runtime_chain&, runtime_state&, runtime_matrix<double>&);
#endif

}  // namespace kte::detail

#pragma once
#pragma GCC system_header  // suppresses warnings about the macros

#include <kte/detail/call.hpp>
#include <kte/frames/motion.hpp>
#include <kte/kernels/joint_vector.hpp>
#include <kte/math/eigen.hpp>
#include <kte/static_chain/static_chain.hpp>

/// Compile errors, one sentence each, for calls that are meant for a chain of the other kind. Valid calls never select
/// these overloads.
namespace kte {

class runtime_chain;

// The last argument is the return type; it only prevents follow-up errors.
#define KTE_ASKED_BY_NAME(algorithm, arguments, ...)                                                                  \
  template <class Gravity, class... E, class... A>                                                                    \
  requires(text_type<A> || ...) auto algorithm(const static_chain<Gravity, E...>&, const A&...) {                     \
    static_assert(detail::fit<A...>, "kte: items of a static chain are named by keys, " #algorithm "(arm, " arguments \
                                     ", hand); texts are for runtime chains");                                        \
    return __VA_ARGS__();                                                                                             \
  }                                                                                                                   \
  template <class... A>                                                                                               \
  requires(key_type<A> || ...) auto algorithm(const runtime_chain&, const A&...) {                                    \
    static_assert(detail::fit<A...>, "kte: items of a runtime chain are named by texts, " #algorithm                  \
                                     "(arm, s, " arguments ", \"hand\"); keys are for static chains");                \
    return __VA_ARGS__();                                                                                             \
  }
#define KTE_STATE_OF_STATIC_CHAIN(algorithm, ...)                                                            \
  template <class S, class Wiring, class... A>                                                               \
  auto algorithm(const runtime_chain&, const chain_state<S, Wiring>&, const A&...) {                         \
    static_assert(detail::fit<Wiring>,                                                                       \
                  "kte: this is the state of a static chain; a runtime chain makes its own: make_state(c)"); \
    return __VA_ARGS__();                                                                                    \
  }
#define KTE_STATE_FORGOTTEN(algorithm, count, arguments, ...)                                         \
  template <indexable... A>                                                                           \
  requires(sizeof...(A) == count) auto algorithm(const runtime_chain&, const A&...) {                 \
    static_assert(detail::fit<A...>,                                                                  \
                  "kte: algorithms on runtime chains work in a state, the second argument: auto s = " \
                  "make_state(c); " #algorithm "(c, s, " arguments ")");                              \
    return __VA_ARGS__();                                                                             \
  }

KTE_ASKED_BY_NAME(forward_kinematics, "q", pose<mat3<vec3<>>, vec3<>>)
KTE_ASKED_BY_NAME(jacobian, "q", Eigen::Matrix<double, 6, Eigen::Dynamic>)
KTE_ASKED_BY_NAME(frame_velocity, "q, v", linear_angular<double>)
KTE_ASKED_BY_NAME(frame_acceleration, "q, v, a", linear_angular<double>)

KTE_STATE_OF_STATIC_CHAIN(forward_dynamics, Eigen::VectorXd)
KTE_STATE_OF_STATIC_CHAIN(inverse_dynamics, Eigen::VectorXd)
KTE_STATE_OF_STATIC_CHAIN(mass_matrix, Eigen::MatrixXd)

KTE_STATE_FORGOTTEN(forward_dynamics, 3, "q, v, tau", Eigen::VectorXd)
KTE_STATE_FORGOTTEN(inverse_dynamics, 3, "q, v, a", Eigen::VectorXd)
KTE_STATE_FORGOTTEN(mass_matrix, 1, "q", Eigen::MatrixXd)
KTE_STATE_FORGOTTEN(forward_kinematics, 2, "q, \"hand\"", pose<mat3<vec3<>>, vec3<>>)
KTE_STATE_FORGOTTEN(jacobian, 2, "q, \"hand\"", Eigen::Matrix<double, 6, Eigen::Dynamic>)

#undef KTE_ASKED_BY_NAME
#undef KTE_STATE_OF_STATIC_CHAIN
#undef KTE_STATE_FORGOTTEN

}  // namespace kte

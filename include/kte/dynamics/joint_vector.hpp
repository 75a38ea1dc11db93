#pragma once

#include <kte/errors.hpp>

#include <Eigen/Core>

#include <concepts>

namespace kte {

/// One number a degree of freedom.
template <class S, int N>
using joint_vector = Eigen::Matrix<S, N, 1>;
template <class S, int N>
using joint_matrix = Eigen::Matrix<S, N, N>;

/// What fused algorithms take for q, v, a, tau: an Eigen vector, std::array, std::span, a pointer.
template <class T>
concept indexable = requires(const T& x, std::size_t i) {
  x[i];
};

template <indexable T>
using value_of = std::remove_cvref_t<decltype(std::declval<const T&>()[std::size_t{}])>;

/// Rejects arguments of the wrong size, where the size is known.
template <indexable T>
constexpr void check_size(std::size_t n, const T& x, const char* name) {
  if constexpr (requires { x.size(); }) {
    if (static_cast<std::size_t>(x.size()) != n) [[unlikely]]
      detail::raise<bad_argument>(std::string("kte: ") + name + " has " + std::to_string(x.size()) +
                                  " numbers, the chain has " + std::to_string(n) + " degrees of freedom");
  }
}
template <int N, indexable T>
constexpr void check_size(const T& x, const char* name) {
  check_size(std::size_t{N}, x, name);
}

}  // namespace kte

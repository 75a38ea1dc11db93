#pragma once

/// The headers of std, Eigen, Boost.Hana and of POSIX that headers of kte include, and those of other libraries that
/// are there.
#include <Eigen/Dense>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <boost/hana/at.hpp>
#include <boost/hana/flatten.hpp>
#include <boost/hana/for_each.hpp>
#include <boost/hana/transform.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <cxxabi.h>
#include <deque>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <numbers>
#include <numeric>
#include <optional>
#include <ostream>
#include <queue>
#include <random>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <unistd.h>
#include <unordered_map>
#include <unordered_set>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>
#include <variant>
#include <vector>
#include <version>
#if __has_include(<boost/numeric/odeint.hpp>)
#  include <boost/numeric/odeint/algebra/algebra_dispatcher.hpp>
#  include <boost/numeric/odeint/external/eigen/eigen.hpp>
#  include <boost/numeric/odeint/util/state_wrapper.hpp>
#endif
#if __has_include(<cereal/cereal.hpp>)
#  include <cereal/archives/json.hpp>
#  include <cereal/archives/xml.hpp>
#endif
#if __has_include(<sundials/sundials_context.h>)
#  include <arkode/arkode_arkstep.h>
#  include <cvode/cvode.h>
#  include <cvode/cvode_ls.h>
#  include <ida/ida.h>
#  include <ida/ida_ls.h>
#  include <nvector/nvector_serial.h>
#  include <sundials/sundials_context.h>
#  include <sunlinsol/sunlinsol_dense.h>
#  include <sunmatrix/sunmatrix_dense.h>
#  include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#endif
#if __has_include(<tinyxml2.h>)
#  include <tinyxml2.h>
#endif
#if __has_include(<xsimd/xsimd.hpp>)
#  include <xsimd/xsimd.hpp>
#endif

#include <kte/detail/function_ref.hpp>

#include <string>

#include "catch.hpp"

namespace function_ref_test {

using kte::detail::function_ref;

void three_times(function_ref<void(int, std::string&)> f, std::string& to) {
  for (int i = 0; i < 3; ++i) f(i, to);
}

TEST_CASE("what is no template calls what it is given, which is not copied") {
  std::string text;
  int calls = 0;
  three_times(
      [&calls](int i, std::string& to) {
        ++calls;
        to += std::to_string(i);
      },
      text);
  CHECK(text == "012");
  CHECK(calls == 3);

  struct counter {
    mutable int n = 0;
    counter() = default;
    counter(const counter&) = delete;
    void operator()(int, std::string&) const { ++n; }
  };
  const counter here;
  three_times(here, text);
  CHECK(here.n == 3);
}

}  // namespace function_ref_test

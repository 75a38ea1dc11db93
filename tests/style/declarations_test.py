#!/usr/bin/env python3
"""tools/reference/declarations.py reads declarations of C++20 that are easily misread, with their comments."""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'tools', 'reference'))
from declarations import Unreadable, declarations  # noqa: E402

TEXT = r'''
#define MACRO(x) {
namespace kte {
/// A number.
///
///   x > 0     (1)
template <class T, int N = (3 > 2)>
concept number = requires(T x) { { x + x } -> std::same_as<T>; } && (N > 0);
/// Constrained.
template <class T>
requires number<T> && (!std::is_void_v<T>) && requires { typename T::value; }
[[nodiscard]] KTE_INLINE constexpr auto square(const T& x, const char* text = "};{") requires(sizeof(T) > 1) {
  return [&]<int... I>(std::integer_sequence<int, I...>) { return x[y[0]]; };
}
template <class T>
inline constexpr bool has_value = requires { typename T::value; };
inline constexpr bool go_on = true, stop = 1'000 < 2;  ///< What observers return.
inline constexpr struct tag_ final : key<"tag"> {} tag;
std::array<std::string_view, 2> names();
template <>
struct number_of<double> {};
/// A state.
class state : public base<state, 3> {
 public:
  explicit state(int n) : size_{n}, all_(n) {}
  state(const state&) = delete;
  bool operator<(const state& other) const;
  double q, v;  ///< rad, rad/s
  static constexpr auto table = make<int, 3>(1, 2);
  double& at(int i) { return all_[i]; }

 private:
  int hidden;
};
template <class T>
void state::later(T) {}
enum class mode {
  on,  ///< It works.
  off = 3
};
MACRO(a)
}  // namespace kte
'''
EXPECTED = [
    ('concept', 'number', 'A number.\n\n  x > 0     (1)', True), ('function', 'square', 'Constrained.', True),
    ('variable', 'has_value', '', True), ('variable', 'go_on', 'What observers return.', True),
    ('variable', 'stop', 'What observers return.', True), ('variable', 'tag', '', True), ('function', 'names', '', True),
    ('class', 'state', 'A state.', True), ('variable', 'state::q', 'rad, rad/s', True),
    ('variable', 'state::v', 'rad, rad/s', True), ('variable', 'state::table', '', True), ('function', 'state::at', '', True),
    ('variable', 'state::hidden', '', False), ('enum', 'mode', '', True), ('enumerator', 'mode::on', 'It works.', True),
    ('enumerator', 'mode::off', '', True)]


def flat(listed):
    for x in listed:
        if x.kind == 'namespace':
            yield from flat(x.members)
        elif not x.special:
            yield x.kind, '::'.join(x.scope[1:] + (x.name,)), x.doc, x.public
            yield from flat(x.members)


found = list(flat(declarations(TEXT)))
for pair in zip(found, EXPECTED):
    if pair[0] != pair[1]:
        sys.exit(f'found    {pair[0]}\nexpected {pair[1]}')
if len(found) != len(EXPECTED):
    sys.exit(f'{len(found)} declarations instead of {len(EXPECTED)}')
square = declarations(TEXT)[0].members[1].text
if not square.endswith('requires(sizeof(T) > 1)') or 'requires number<T>' not in square:
    sys.exit('the constraints are lost: ' + square)
for wrong in ('namespace kte {\nint x;\n', 'int x;\n}\n', 'template <class T\nint x;\n'):
    try:
        declarations(wrong)
    except Unreadable:
        continue
    sys.exit('read: ' + wrong)

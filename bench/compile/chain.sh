# Sourced by measure.sh and gate.sh: the programs they compile.

# All three algorithms on a chain $1 with $2 degrees of freedom.
use() {
  cat <<END
using vector = Eigen::Matrix<double, $2, 1>;
vector tau(const vector& q, const vector& v, const vector& a) { return kte::inverse_dynamics($1, q, v, a); }
Eigen::Matrix<double, $2, $2> mass(const vector& q) { return kte::mass_matrix($1, q); }
vector acceleration(const vector& q, const vector& v, const vector& tau) {
  return kte::forward_dynamics($1, q, v, tau);
}
END
}

# A serial chain of $1 revolute joints about z: links with offsets and quarter turns, bodies of general inertia.
serial() {
  awk -v n="$1" 'BEGIN {
    print "#include <kte/kte.hpp>"
    key = "inline constexpr struct %s_ final : kte::%s_key<\"%s\"> {} %s;\n"
    printf key, "base", "frame_3D", "base", "base"
    for (i = 1; i <= n; ++i) {
      printf key, "q" i, "coord", "q" i, "q" i
      printf key, "mount" i, "frame_3D", "mount" i, "mount" i
      printf key, "link" i, "frame_3D", "link" i, "link" i
    }
    print "inline constexpr auto model = kte::chain("
    split("x y z", turn, " ")
    for (i = 1; i <= n; ++i) {
      from = i == 1 ? "base" : "link" (i - 1)
      printf "    kte::rigid_link_3D(%s, mount%d, kte::vec3{0.0%d, -0.1, 0.2}, kte::quarter_turn_%s),\n", from, i,
             i % 9 + 1, turn[i % 3 + 1]
      printf "    kte::revolute_joint_3D(q%d, mount%d, link%d),\n", i, i, i
      printf "    kte::inertia_3D(link%d, kte::rigid_body{1.%d, kte::vec3{0.01, -0.02, 0.1},\n", i, i
      printf "                    kte::sym3{0.02, 0.001, -0.002, 0.03, 0.0005, 0.025}})%s\n", i < n ? "," : ")"
    }
    print "    .gravity(kte::along_z(-9.81));"
  }'
  use model "$1"
}

# Template instantiations of $1.cpp in $work, "functions classes": the same in every run of one compiler. By g++
# functions that an object file without any inlining defines, and classes that are laid out; by clang what it traces,
# which is more.
instantiations() {
  case $($CXX --version) in
    *clang*)
      unoptimised "$1" -ftime-trace -ftime-trace-granularity=0
      for what in Function Class; do
        grep -o "\"Instantiate$what\"" "$work/$1.json" | wc -l
      done | paste -s -d ' ' -
      ;;
    *)
      unoptimised "$1" -fdump-lang-class="$work/$1.classes"
      echo "$(nm "$work/$1.o" | grep -c ' [tTwW] ') $(grep -c '^Class ' "$work/$1.classes")"
      ;;
  esac
}
unoptimised() {
  program=$1
  shift
  $CXX -std=c++20 -O0 -DKTE_NO_FORCED_INLINE -isystem /usr/include/eigen3 -I"$root/include" -I"$root/examples" "$@" \
    -c "$work/$program.cpp" -o "$work/$program.o"
}

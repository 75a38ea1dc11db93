#pragma once

#include <Eigen/Core>

#include "data/problems/error.hpp"

namespace kte::problems {

/// PLEIADES: seven stars in the plane, of masses 1 to 7, that attract each other and come close. Not stiff.
///
///   r_i'' = sum_j m_j (r_j - r_i) / |r_j - r_i|^3          (1)
///
/// State: x of all, y of all, then their rates.
///
/// Mazzia and Magherini, Test Set for Initial Value Problem Solvers, 2008.
template <class S = double>
struct pleiades {
  static constexpr const char* name = "PLEIADES";
  static constexpr int size = 28;
  static constexpr long double t_end = 3L;
  using state = Eigen::Matrix<S, size, 1>;

  static state start() {
    state x = state::Zero();
    x.template head<14>() << 3, 3, -1, -3, 2, -2, 2, 3, -3, 2, 0, 0, -4, 4;
    x[19] = S(7) / 4, x[20] = S(-3) / 2, x[24] = S(-5) / 4, x[25] = 1;
    return x;
  }
  state operator()(const S&, const state& x) const {
    state f;
    f.template head<14>() = x.template tail<14>();
    f.template tail<14>().setZero();
    for (int i = 0; i < stars; ++i)
      for (int j = 0; j < i; ++j) {
        const S dx = x[j] - x[i], dy = x[stars + j] - x[stars + i], d = distance(dx, dy), cube = d * d * d;
        pull(f, i, S(S(j + 1) / cube), dx, dy);
        pull(f, j, S(S(-i - 1) / cube), dx, dy);
      }
    return f;
  }
  /// Kinetic and of gravity; constant.
  S energy(const state& x) const {
    S e(0);
    for (int i = 0; i < stars; ++i) {
      const S u = x[2 * stars + i], v = x[3 * stars + i];
      e += S(i + 1) * (u * u + v * v) / 2;
      for (int j = 0; j < i; ++j) e -= S((i + 1) * (j + 1)) / distance(S(x[j] - x[i]), S(x[stars + j] - x[stars + i]));
    }
    return e;
  }

  /// Integrated twice at 60 digits, by extrapolation of different orders; only digits on which both agree.
  static constexpr known<28> references[1]{
      {3.0L, {0.370613914397051290093950917727L,  3.23728409205723309280333039050L,   -3.22255903241832334710013146734L,
              0.659709145577530835934995555763L,  0.342558170715657979037735981093L,  1.56217210140063101604570821175L,
              -0.700309292221249538514732670819L, -3.94343758551739205527788317158L,  -3.27138097397254992802067685147L,
              5.22508184345654419243873813721L,   -2.59061243497746951081119135705L,  1.19821369339227463751400241058L,
              -0.242968234493582340916111633444L, 1.09144924042897974788206366269L,   3.41700380631431475229189259751L,
              1.35458450162550122147698199398L,   -2.59006559781077541961863144135L,  2.02505373471424110648501305990L,
              -1.15581510016044909271194591505L,  -0.807298817022302172565972072698L, 0.595239635420871876660792501487L,
              -3.74124496123400847120474539618L,  0.377345968575062903655827116093L,  0.938685886955107888694681526166L,
              0.366792222720056986669641068628L,  -0.347404635380849436600716532806L, 2.34491544818093692314231717888L,
              -1.94702043426329190067426258547L}}};
  static constexpr const auto& reference = references[0].values;

 private:
  static constexpr int stars = 7;

  static S distance(const S& dx, const S& dy) {
    using std::sqrt;
    return sqrt(S(dx * dx + dy * dy));
  }
  static void pull(state& f, int star, const S& a, const S& dx, const S& dy) {  // (1)
    f[2 * stars + star] += a * dx;
    f[3 * stars + star] += a * dy;
  }
};

}  // namespace kte::problems

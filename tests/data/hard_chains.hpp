#pragma once

#include <kte/kte.hpp>

#include <cmath>
#include <span>
#include <string>
#include <vector>

/// Serial chains that are hard on algorithms by their length or their masses, with the accelerations that their motors
/// and gravity cause. In brackets: the condition of the mass matrix, and the error in double of articulated bodies and
/// of the mass matrix with Cholesky as measured elsewhere, relative to the largest acceleration. Rounding the inputs to
/// double changes every case by less than 3e-16.
namespace kte::reference {

/// q_ddot of a degree of freedom; they count from 0.
struct acceleration {
  int dof;
  long double value;
};

/// A chain, its state, and what it does: `accelerations` of some or all degrees of freedom, and the largest of all in
/// size.
struct hard_chain {
  runtime_chain chain;
  std::vector<double> q, v, tau;
  std::span<const acceleration> accelerations;
  long double largest;
};

/// Evaluated at 60 digits by articulated bodies; 21 are given. They agree with a second program to 38.
namespace hard_chain_values {
// clang-format off
inline constexpr acceleration rods_10[] = {
    {0, 9.94535533400036928359L}, {1, -25.0806441811332352382L}, {2, 10.0463726567054846605L},
    {3, 6.90272086668624658916L}, {4, 3.58696661208564926885L}, {5, -2.05790987599041559462L},
    {6, -4.37158851554271192136L}, {7, -1.53625740498640354278L}, {8, 1.4126256006052212463L},
    {9, 2.70414219411359425549L}};
inline constexpr long double largest_rods_10 = 25.0806441811332352382L;
inline constexpr acceleration rods_100[] = {
    {0, 10.4783147909265341666L}, {1, -26.0550872809507182603L}, {2, 10.004833202752743874L},
    {9, 2.42278787325439667278L}, {19, -0.704223184803284199094L}, {29, 0.632394393028729946444L},
    {39, -0.563158896878143330654L}, {49, 0.193269695287350225312L}, {59, 0.261090425078222750742L},
    {69, -0.461106928820504026988L}, {79, 0.572444553326755773571L}, {89, -0.567021864383379907015L},
    {97, 0.388878392588586995748L}, {98, 0.277316431863550902992L}, {99, -0.192051800168966563317L}};
inline constexpr long double largest_rods_100 = 26.0550872809507182603L;
inline constexpr acceleration rods_1000[] = {
    {0, 10.4783147911414061493L}, {1, -26.055087281343580192L}, {2, 10.0048332027359851178L},
    {49, 0.193275376467733825322L}, {99, 0.400120567412981859958L}, {149, 0.545579080589758183215L},
    {199, 0.618492555708174423142L}, {249, 0.627846843152018936599L}, {299, 0.593245250285596438064L},
    {349, 0.539540239006664685163L}, {399, 0.486775271336201447312L}, {449, 0.432863866677748266307L},
    {499, 0.349545113844148462912L}, {549, 0.205175476092643720036L}, {599, -0.00146331800063618357019L},
    {649, -0.230708953440669961288L}, {699, -0.429222444225118609369L}, {749, -0.562696258128784115024L},
    {799, -0.624025579245181298963L}, {849, -0.624504844178996047125L}, {899, -0.584941654000619189038L},
    {949, -0.53038451255574489095L}, {997, 0.236384384234186551914L}, {998, -0.301089113309948496922L},
    {999, -0.354397550712533178739L}};
inline constexpr long double largest_rods_1000 = 26.055087281343580192L;
inline constexpr acceleration heavy_tip[] = {
    {0, 11.322693750010625035L}, {1, -27.5992160129692767277L}, {2, 9.94076227089935594695L},
    {3, 7.36938396241012969669L}, {4, 5.08126511184794459955L}, {5, -0.563970008739777835407L},
    {6, -4.44201071706531433354L}, {7, -5.23405551976797268025L}, {8, 2.63417491555872831621L},
    {9, 1.49098894241656380416L}};
inline constexpr long double largest_heavy_tip = 27.5992160129692767277L;
inline constexpr acceleration alternating[] = {
    {0, 13.0014389603006667393L}, {1, -37.7448809460450778738L}, {2, 26.7161025248946787653L},
    {3, 1.44832391541328077648L}, {4, -2.94782739616526395037L}, {5, 7.26245477379617988105L},
    {6, -9.14205618530981547201L}, {7, -3.58573566207938247621L}, {8, 5.09948269469147534074L},
    {9, 1.67041002368350571178L}};
inline constexpr long double largest_alternating = 37.7448809460450778738L;
inline constexpr acceleration shrinking[] = {
    {0, -2.98134293823393493165L}, {1, 0.0842367474164757710979L}, {2, 3.05528212262443476613L},
    {3, 2.78850023159712359775L}, {4, 0.0179285571884230752049L}, {5, -2.57744035306124807538L},
    {6, -3.04622127603595047608L}, {7, -0.416827961103498280024L}, {8, 2.24005757620029313379L},
    {9, 3.80297622408669960234L}};
inline constexpr long double largest_shrinking = 3.80297622408669960234L;
inline constexpr acceleration spatial_6[] = {
    {0, -2.65621210513907679373L}, {1, 5.03735331132853428362L}, {2, 0.804408773343509347323L},
    {3, 16.4308692241383543761L}, {4, 5.11909129226727040375L}, {5, -81.6186301156598941877L}};
inline constexpr long double largest_spatial_6 = 81.6186301156598941877L;
inline constexpr acceleration spatial_30[] = {
    {0, -3.754233388387431119L}, {1, 2.46373563385529175489L}, {2, 5.43729025825876860048L},
    {3, 16.2778104884461907662L}, {4, -2.70431306831323711029L}, {5, -40.9750089395902382081L},
    {6, 13.7532204851685852606L}, {7, -28.5508376912355846286L}, {8, 42.3443258846474336644L},
    {9, 18.7910290995438238711L}, {10, 1.5726259006065024159L}, {11, -52.5581991924269380884L},
    {12, 47.2667239510123556971L}, {13, -18.7737899337062775606L}, {14, 58.6056909492240905343L},
    {15, 14.4304592876452225492L}, {16, 21.065051656888967725L}, {17, -35.3748262881467397619L},
    {18, 11.9286140710613017673L}, {19, -22.9207559655801795949L}, {20, 19.5257506653096336839L},
    {21, -16.1015856211000679815L}, {22, 49.5962566418992111679L}, {23, 48.1444100446933618289L},
    {24, -45.414234933956699486L}, {25, -57.3598280218315315959L}, {26, -79.0136384452530373795L},
    {27, -70.1149185863164353432L}, {28, 26.8906009103962755342L}, {29, 146.927518300029469314L}};
inline constexpr long double largest_spatial_30 = 146.927518300029469314L;
inline constexpr acceleration spatial_100[] = {
    {0, -3.75430330476915036908L}, {1, 2.4637888149623372586L}, {2, 5.43563104044322092769L},
    {9, 18.7941841937769185161L}, {19, -25.1086808057214512289L}, {29, 161.45590818480414948L},
    {39, -284.855820302508369905L}, {49, -2.87703531454113403542L}, {59, -191.924141042684759952L},
    {69, -24.3715232798587938026L}, {79, 346.895770666562739652L}, {89, -33.747066532113497306L},
    {97, 418.29843533371207555L}, {98, 554.391152486407205413L}, {99, 183.681826530292592896L}};
inline constexpr long double largest_spatial_100 = 1312.84819683790445543L;
inline constexpr acceleration spatial_300[] = {
    {0, -3.75430330476915036889L}, {1, 2.46378881496233725581L}, {2, 5.43563104044322095552L},
    {19, -25.1086808057214238033L}, {39, -284.855820303001186228L}, {59, -191.924138793122406154L},
    {79, 346.577217649024204099L}, {99, 410.302280062538524923L}, {119, -39.3448514042964421224L},
    {139, -585.35375555667486297L}, {159, -3014.26793914819581443L}, {179, -403.185548885513186595L},
    {199, 570.677142855179376556L}, {219, -3018.31978731529733265L}, {239, -414.535995456123347761L},
    {259, -1272.73885934937856022L}, {279, 1046.97927168573522161L}, {297, -11490.6729605091048168L},
    {298, 4359.41417539490630924L}, {299, 6108.17909869060906098L}};
inline constexpr long double largest_spatial_300 = 12688.6089401175163626L;
inline constexpr acceleration spatial_heavy_tip[] = {
    {0, -14.1173921342650374263L}, {1, -0.950309073980298247993L}, {2, 23.3930657089615902602L},
    {3, 47.1341887176851873102L}, {4, -21.4244446811864469933L}, {5, -45.5745754113989657581L}};
inline constexpr long double largest_spatial_heavy_tip = 47.1341887176851873102L;
// clang-format on
}  // namespace hard_chain_values

/// max |q_ddot - exact| / max |exact| over the degrees of freedom whose acceleration is given.
template <class Accelerations>
long double error_of(const Accelerations& q_ddot, const hard_chain& c) {
  long double e = 0;
  for (const auto& x : c.accelerations) {
    const auto d = std::fabs(static_cast<long double>(q_ddot[x.dof]) - x.value);
    if (d > e || d != d) e = d;  // also if it is NaN
  }
  return e / c.largest;
}

namespace detail {

/// n uniform rods of length 1 m in the plane, of mass(i) kg, that hang along x; i counts from 1:
///   q_i = 0.3 sin i,  v_i = 0.5 cos 2i,  tau = 0
template <class Mass>
hard_chain rods(int n, const Mass& mass) {
  hard_chain r{};
  r.chain.gravity(along_x(9.81));
  std::string mount = "base";
  for (int i = 1; i <= n; ++i) {
    const auto number = std::to_string(i);
    const double m = mass(i);
    r.chain << revolute_joint_2D("q" + number, mount, "link" + number)
            << inertia_2D("link" + number, planar_body(m, m / 12, along_x(0.5)));
    if (i < n) r.chain << rigid_link_2D("link" + number, "mount" + std::to_string(i + 1), along_x(1.0));
    mount = "mount" + std::to_string(i + 1);
    r.q.push_back(0.3 * std::sin(i)), r.v.push_back(0.5 * std::cos(2 * i)), r.tau.push_back(0);
  }
  return r;
}

/// n equal bodies of 1 kg in space, 0.3 m apart along x, with axes z, y, x in turn; the last one is `tip` times as
/// heavy:
///   q_i = sin i,  v_i = cos 2i,  tau_i = sin 3i
inline hard_chain spatial(int n, double tip = 1) {
  hard_chain r{};
  r.chain.gravity(along_z(-9.81));
  std::string mount = "base";
  for (int i = 1; i <= n; ++i) {
    const auto number = std::to_string(i);
    const auto q = "q" + number, link = "link" + number;
    const double m = i == n ? tip : 1;
    if (i % 3 == 1) r.chain << revolute_joint_3D(q, mount, link, axis::z);
    if (i % 3 == 2) r.chain << revolute_joint_3D(q, mount, link, axis::y);
    if (i % 3 == 0) r.chain << revolute_joint_3D(q, mount, link, axis::x);
    r.chain << inertia_3D(link, rigid_body{m, vec3{0.15, 0.02, -0.01},
                                           sym3{0.01 * m, 0.001 * m, -0.002 * m, 0.02 * m, 0.003 * m, 0.015 * m}});
    if (i < n) r.chain << rigid_link_3D(link, "mount" + std::to_string(i + 1), along_x(0.3));
    mount = "mount" + std::to_string(i + 1);
    r.q.push_back(std::sin(i)), r.v.push_back(std::cos(2 * i)), r.tau.push_back(std::sin(3 * i));
  }
  return r;
}

template <std::size_t N>
hard_chain with(hard_chain c, const acceleration (&a)[N], long double largest) {
  c.accelerations = a;
  c.largest = largest;
  return c;
}

}  // namespace detail

/// Equal rods, almost straight: the condition grows as 4 n^4 [4e4, 4e8, 4e12; articulated bodies 7e-16, 2e-14, 8e-12;
/// mass matrix 5e-14, 1e-9, 5e-7]. n is 10, 100 or 1000; for others there are no accelerations.
inline hard_chain uniform_rods(int n) {
  using namespace hard_chain_values;
  auto c = detail::rods(n, [](int) { return 1.0; });
  if (n == 10) return detail::with(std::move(c), rods_10, largest_rods_10);
  if (n == 100) return detail::with(std::move(c), rods_100, largest_rods_100);
  if (n == 1000) return detail::with(std::move(c), rods_1000, largest_rods_1000);
  return c;
}
/// Ten rods of 1 kg, the last of 1e6 kg: a heavy load on light links, where the inertias of the light ones are lost in
/// its own [1e10; 9e-12; 1.5e-7].
inline hard_chain heavy_tip_rods() {
  return detail::with(detail::rods(10, [](int i) { return i == 10 ? 1e6 : 1.0; }), hard_chain_values::heavy_tip,
                      hard_chain_values::largest_heavy_tip);
}
/// Ten rods of 1e-6 and 1e6 kg in turn, the first one light [5e4; 4e-16; 2e-13].
inline hard_chain alternating_rods() {
  return detail::with(detail::rods(10, [](int i) { return i % 2 == 1 ? 1e-6 : 1e6; }), hard_chain_values::alternating,
                      hard_chain_values::largest_alternating);
}
/// Ten rods of 1e4, 1e3, ... 1e-5 kg: a whip. Bad for the condition, yet harmless [3e9; 6e-16; 2e-14].
inline hard_chain shrinking_rods() {
  static constexpr double mass[]{1e4, 1e3, 1e2, 1e1, 1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
  return detail::with(detail::rods(10, [](int i) { return mass[i - 1]; }), hard_chain_values::shrinking,
                      hard_chain_values::largest_shrinking);
}
/// Long chains in space, far from straight [5e2, 2e5, 6e6, 5e8; 7e-16, 5e-15, 2e-13, 5e-13; 4e-16, 1e-13, 4e-12,
/// 2e-11]. n is 6, 30, 100 or 300; for others there are no accelerations.
inline hard_chain spatial_chain(int n) {
  using namespace hard_chain_values;
  auto c = detail::spatial(n);
  if (n == 6) return detail::with(std::move(c), spatial_6, largest_spatial_6);
  if (n == 30) return detail::with(std::move(c), spatial_30, largest_spatial_30);
  if (n == 100) return detail::with(std::move(c), spatial_100, largest_spatial_100);
  if (n == 300) return detail::with(std::move(c), spatial_300, largest_spatial_300);
  return c;
}
/// Six bodies in space, the last one a million times as heavy [4e3; 2e-14; 6e-14].
inline hard_chain heavy_tip_spatial_chain() {
  return detail::with(detail::spatial(6, 1e6), hard_chain_values::spatial_heavy_tip,
                      hard_chain_values::largest_spatial_heavy_tip);
}

}  // namespace kte::reference

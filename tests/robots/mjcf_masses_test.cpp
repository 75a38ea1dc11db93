#include <kte/math/principal_moments.hpp>

#include "robots/mjcf_texts.hpp"
#include "robots/sdf_texts.hpp"

namespace mjcf_masses_test {

using namespace kte;
using test::has, test::says, test::mjcf_texts::mjcf, test::mjcf_texts::texts;

/// A prism whose cross-section is a U: 4 x 3 with a gap of 2 x 2, 2 m high. Its volume is 16 m^3.
const std::string u_vertices =
    "0 0 0 4 0 0 4 3 0 3 3 0 3 1 0 1 1 0 1 3 0 0 3 0 0 0 2 4 0 2 4 3 2 3 3 2 3 1 2 1 1 2 1 3 2 0 3 2";
const std::string u_faces =
    "0 4 1 0 5 4 0 7 5 5 7 6 1 3 2 1 4 3 8 9 12 8 12 13 8 13 15 13 14 15 9 10 11 9 11 12 0 1 9 0 9 8 1 2 10 1 10 9 2 3 "
    "11 2 11 10 3 4 12 3 12 11 4 5 13 4 13 12 5 6 14 5 14 13 6 7 15 6 15 14 7 0 8 7 8 15";

std::string of_mesh(const std::string& attributes, const std::string& geom = "", const std::string& before = "") {
  return mjcf("<body name='b'><joint/><geom type='mesh' mesh='u' density='1' " + geom + "/></body>",
              before + "<asset><mesh name='u' " + attributes + "/></asset>");
}
rigid_body<> body_of(const std::string& text) { return from_mjcf(text).links[1].inertial.value(); }

TEST_CASE("the mass of a mesh is that of its volume, unless the file says otherwise") {
  const auto mesh = "vertex='" + u_vertices + "' face='" + u_faces + "' ";
  const auto d = from_mjcf(of_mesh(mesh));
  CHECK(d.links[1].inertial->mass == within(16, 1e-14));
  CHECK(d.links[1].inertial->com.y == within(1.25, 1e-15));
  CHECK(d.warnings.size() == 1);
  CHECK(has(d.warnings,
            "mesh 'u': its mass is that of the volume that it encloses; by the rule 'legacy', the default of MuJoCo, "
            "it would be 39.7 % larger, and by its convex hull 50 %"));
  CHECK(from_mjcf(of_mesh(mesh + "inertia='exact'")).warnings.empty());
  // figures of MuJoCo 4.0.0
  CHECK(body_of(of_mesh(mesh + "inertia='legacy'")).mass == within_relative(22.35672929, 1e-9));
  CHECK(body_of(of_mesh(mesh, "", "<compiler exactmeshinertia='false'/>")).mass == within_relative(22.35672929, 1e-9));
  CHECK(body_of(of_mesh(mesh + "inertia='convex'")).mass == within(24, 1e-14));
  CHECK(body_of(of_mesh(mesh + "inertia='shell'")).mass == within(52, 1e-13));

  CHECK(body_of(of_mesh(mesh + "scale='-1 1 1'")).mass == within(16, 1e-14));  // mirrored
  // faces that point inwards: of a closed surface the other side is meant
  const std::string cube = "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1";
  const std::string in = "0 1 2 1 3 2 4 6 5 5 6 7 0 4 1 1 4 5 2 3 6 3 7 6 0 2 4 2 6 4 1 5 3 3 5 7";
  const auto inwards = from_mjcf(of_mesh("vertex='" + cube + "' face='" + in + "'"));
  CHECK(inwards.links[1].inertial->mass == within(1, 1e-15));
  CHECK(texts(inwards.warnings) == "mesh 'u': its faces point inwards; they are taken as pointing outwards\n");
  // a surface that is open has no volume: legacy, by the figure of MuJoCo 4.0.0
  const auto open = from_mjcf(of_mesh("vertex='" + cube + "' face='" + in.substr(6) + "'"));
  CHECK(has(open.warnings, "mesh 'u': its surface is not closed, so that its mass may be wrong; the rule 'legacy' is"));
  CHECK(open.links[1].inertial->mass == within(0.9106060606060608, 4e-16));
}

TEST_CASE("meshes that MJCF makes from parameters have the masses of MuJoCo 4.0.0") {
  // MuJoCo rounds vertices to float, by up to 6e-8: masses agree to three times this, moments to five times
  struct figures {
    const char *kind, *params;
    double mass;
    std::array<double, 3> moments;
  };
  for (const auto& f : {figures{"sphere", "0", 2.5361504726624076, {0.73407024, 0.73407024, 0.73407024}},
                        figures{"sphere", "3", 4.152740778128605, {1.65155740, 1.65155740, 1.65155740}},
                        figures{"hemisphere", "2", 1.7856405784234899, {0.64317339, 0.41905139, 0.41905139}},
                        figures{"hemisphere", "5", 2.0088342784067814, {0.78160378, 0.50762856, 0.50762856}},
                        figures{"cone", "4 0.5", 2.333333333333333, {0.95119048, 0.95119048, 0.51666667}},
                        figures{"cone", "12 0.3", 2.779999976059955, {1.10255957, 1.10255957, 0.81687454}},
                        figures{"supersphere", "8 2 .5", 3.38061541101931, {1.41084115, 1.41084115, 1.00944055}},
                        figures{"supersphere", "8 3 3", 0.476365685166964, {0.06003479, 0.05525372, 0.05525372}},
                        figures{"supertorus", "8 .5 2 .5", 3.363585693140825, {4.10581561, 2.19305721, 2.19305721}},
                        figures{"supertorus", "4 .3 2 .5", 0.71999997138976, {0.50159996, 0.26159998, 0.26159998}}}) {
    INFO(f.kind << " " << f.params);
    const auto d =
        from_mjcf(of_mesh(std::string("builtin='") + f.kind + "' params='" + f.params + "' inertia='exact'"));
    CHECK(d.warnings.empty());
    const auto& b = d.links[1].inertial.value();
    CHECK(b.mass == within_relative(f.mass, 3e-7));
    const auto moments = principal_moments(b.inertia);
    for (std::size_t i = 0; i < 3; ++i) CHECK(moments[i] == within_relative(f.moments[i], 5e-7));
  }
  const auto refused = [](const std::string& attributes, const std::string& why) {
    CHECK_THROWS_MATCHES(from_mjcf(of_mesh(attributes)), bad_file, says("mesh 'u': " + why));
  };
  refused("builtin='plate' params='2 2'", "the mass of the builtin mesh 'plate' is not read");
  refused("builtin='sphere' params='1 2'", "params of a sphere must have 1 number, got 2");
  refused("builtin='sphere' params='9'", "the first number of params must be a whole number from 0 to 4, got 9");
  refused("builtin='cone' params='3.5 1'", "the first number of params must be a whole number from 3 to 1000, got 3.5");
  refused("builtin='supertorus' params='8 0 1 1'", "number 2 of params must be positive, got 0");
  refused("builtin='sphere'", "has no params");
}

TEST_CASE("shells of simple shapes have the masses of MuJoCo 4.0.0") {
  struct figures {
    const char *type, *size;
    double area, xx, yy, zz;
  };
  for (const auto& f :
       {figures{"box", "1 2 3", 88, 1624.0 / 3, 1264.0 / 3, 728.0 / 3},
        figures{"sphere", "2", 50.26548245743669, 134.0412865531645, 134.0412865531645, 134.0412865531645},
        figures{"capsule", "1 2", 37.69911184307752, 129.8524963483781, 129.8524963483781, 33.510321638291124},
        figures{"cylinder", "1 2", 31.41592653589793, 72.78022980816354, 72.78022980816354, 28.274333882308138},
        figures{"ellipsoid", "1 2 3", 48.97193333, 180.75103342533112, 140.68307422101498, 81.02634166926146}}) {
    INFO(f.type);
    const auto geom = "<geom type='" + std::string(f.type) + "' size='" + f.size + "' shellinertia='true' ";
    // MuJoCo takes the layer of an ellipsoid 1e-6 thick
    const double relative = f.type == std::string("ellipsoid") ? 1e-6 : 1e-14;
    const auto b = body_of(mjcf("<body><joint/>" + geom + "density='1'/></body>"));
    CHECK(b.mass == within_relative(f.area, relative));
    CHECK(b.inertia.xx == within_relative(f.xx, relative));
    CHECK(b.inertia.yy == within_relative(f.yy, relative));
    CHECK(b.inertia.zz == within_relative(f.zz, relative));
    CHECK(body_of(mjcf("<body><joint/>" + geom + "mass='2'/></body>")).inertia.xx ==
          within_relative(2 * f.xx / f.area, relative));
  }
}

TEST_CASE("an inertial in a frame stands where the frame puts it") {
  const auto text = [](const std::string& more) {
    return mjcf("<body><joint/><frame pos='1 0 0'><inertial pos='0 0 1' mass='2' diaginertia='1 2 2'/></frame>" + more +
                "</body>");
  };
  const auto b = body_of(text(""));
  CHECK((b.mass == 2 && b.com == vec3<>{1, 0, 1}));
  CHECK_THROWS_MATCHES(from_mjcf(text("<inertial pos='0 0 0' mass='1'/>")), bad_file, says("<inertial>: occurs twice"));
}

}  // namespace mjcf_masses_test

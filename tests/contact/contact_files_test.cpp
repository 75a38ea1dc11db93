#include <kte/contact/surface.hpp>
#include <kte/contacts.hpp>
#include <kte/elements/registry.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/io/archive_file.hpp>
#include <kte/io/model_file.hpp>
#include <kte/io/print_states.hpp>
#include <kte/io/recording.hpp>
#include <kte/io/state_records.hpp>
#include <kte/kte.hpp>
#include <kte/robots/header.hpp>

#include <sstream>

#include "catch.hpp"
#include "io/scratch.hpp"

namespace contact_files_test {

using namespace kte;
using namespace kte::test;

/// Bodies with all rigid contacts.
runtime_chain touching() {
  const contact_law law{.friction = 0.3, .restitution = 0.6};
  runtime_chain c;
  c << base_3D("ground") << free_joint_3D("pose", "ground", "body") << base_2D("floor")
    << free_joint_2D("place", "floor", "box");
  c << sphere_contact_3D("1", "ground", "body", half_space(vec3<>{0.6, 0, 0.8}), 0.1, law)
    << sphere_contact_3D("2", "ground", "body", bowl_surface(2.0), 0.1, law, vec3{0.1, 0.2, 0.3})
    << sphere_contact_3D("3", "ground", "body", cylinder_surface(0.5), 0.1, law)
    << point_contact_3D("4", "ground", "body", ball_surface(0.5), {})
    << disc_contact_3D("5", "ground", "body", half_space{}, axis::y, 0.3, law)
    << sphere_contact_2D("6", "floor", "box", half_space{}, 0.1, law, vec2{0.1, 0.2})
    << point_contact_2D("7", "floor", "box", ball_surface(0.4), law);
  return c;
}

TEST_CASE("rigid contacts go through records, model files and archives") {
  const auto c = touching();
  const auto record = record_of(c);
  CHECK(record_of(to_chain(record)).elements == record.elements);
  auto s = c.make_state();
  s.contact("6").mode = 2, s.contact("6").force = {1, 2, 0};
  const scratch_folder folder;
  for (const char* extension : {".json", ".xml", ".kte"}) {
    INFO(extension);
    const auto file = folder.path / (std::string("model") + extension),
               both = folder.path / (std::string("archive") + extension);
    save_model(file, c);
    CHECK(record_of(to_chain(load_model(file))).elements == record.elements);
    archive a;
    a.add("bodies", c).add("state", s);
    save_archive(both, a);
    const auto b = load_archive(both);
    auto restored = b.chain("bodies").make_state();
    b.restore("state", restored);
    CHECK(mode_of(restored.contact("6")) == contact_mode::slides);
    CHECK(restored.contact("6").force == s.contact("6").force);
    CHECK(mode_of(restored.contact("1")) == contact_mode::open);
  }
  runtime_chain code;
  code << base_3D("a") << base_3D("b")
       << point_contact_3D("c", "a", "b", surface([](const auto& p) { return p.z; }), {});
  CHECK_THROWS_AS(record_of(code), bad_argument);
}

TEST_CASE("rigid contacts are written into headers, but for those with functions") {
  const auto c = touching();
  const auto text = to_header(c, "bodies");
  for (const auto* call : {
           "::kte::contact_key<\"1\"> {} n1_;",
           "sphere_contact_3D(n1_, ground_, body_, {{0.6, 0.0, 0.8}, 0.0}, 0.1, {0.3, 0.6}, ::kte::zero3{})",
           "sphere_contact_3D(n2_, ground_, body_, {{0.0, 0.0, 0.0}, -2.0}, 0.1, {0.3, 0.6}, ::kte::vec3{0.1, 0.2, "
           "0.3})",
           "sphere_contact_3D(n4_, ground_, body_, {{0.0, 0.0, 0.0}, 0.5}, ::kte::zero, {0.0, 0.0}, ::kte::zero3{})",
           "disc_contact_3D(n5_, ground_, body_, {{0.0, 0.0, 1.0}}, ::kte::axis::y, 0.3, {0.3, 0.6})",
           "sphere_contact_2D(n6_, floor_, box_, {{0.0, 1.0, 0.0}, 0.0}, 0.1, {0.3, 0.6}, ",
       })
    CHECK_THAT(text, contains_text(call));
  auto gated = c;
  gated << point_contact_3D("8", "ground", "body", half_space{}, {}).only_if([](const auto&) { return true; });
  CHECK_THROWS_MATCHES(to_header(gated, "bodies"), bad_argument, says("holds a function of its program"));
  auto hill = c;
  hill << point_contact_3D("9", "ground", "body", surface([](const auto& p) { return p.z; }), {});
  CHECK_THROWS_MATCHES(to_header(hill, "bodies"), bad_argument, says("holds a function of its program"));
}

TEST_CASE("states print contacts, and recordings name their quantities") {
  const auto c = touching();
  auto s = c.make_state();
  c.doMotion(s);
  std::ostringstream out;
  out << s;
  CHECK_THAT(out.str(), contains_text("7  contact  open gap -0.4"));
  s.contact("7").force = {1, 2, 0};
  const detail::recording of(detail::slots_of(*s.made_for()), {"7/force/y", "7/gap", "7/mode"});
  CHECK(of.columns == std::vector<std::string>{"t", "7/force/y", "7/gap", "7/mode"});
}

}  // namespace contact_files_test

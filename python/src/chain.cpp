#include "chain.hpp"

#include <kte/elements/registry.hpp>
#include <kte/io/binary_file.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/runtime_chain/check_chain.hpp>
#include <kte/runtime_chain/layout.hpp>
#include <kte/sweep/varied_chain.hpp>

#include <optional>
#include <pybind11/stl.h>
#include <sstream>

#include "arrays.hpp"
#include "parts.hpp"

namespace kte_python {

kte::runtime_chain& chain_object::edit() {
  if (used_ > 0) throw kte::bad_argument("kte: the chain cannot be changed while another thread computes with it");
  free_.clear(), has_packs_ = -1, compiled_.reset();
  return chain_;
}

lease::lease(const chain_object& c) : chain_(c) {
  if (c.free_.empty()) {
    work_ = std::make_unique<workspace>(workspace{c.chain_.make_state(), {}});
  } else {
    work_ = std::move(c.free_.back());
    c.free_.pop_back();
  }
  ++c.used_;
}
lease::~lease() {
  --chain_.used_;
  if (spoilt_) return;
  try {
    chain_.free_.push_back(std::move(work_));
  } catch (const std::bad_alloc&) {
  }
}

const chain_object& chain_of(py::handle x) {
  static const py::handle type = py::type::of<chain_object>();
  if (x.get_type().is(type) || py::isinstance<chain_object>(x)) return *x.cast<const chain_object*>();
  if (py::hasattr(x, "chain")) {
    const py::object c = x.attr("chain");
    if (py::isinstance<chain_object>(c)) return *c.cast<const chain_object*>();
  }
  throw py::type_error("kte: expected a Chain, or what has one, as a Robot, not " + py::repr(x).cast<std::string>());
}

py::dict dict_from(const char* what, const char* of, py::handle x) {
  if (py::isinstance<py::dict>(x)) return py::reinterpret_borrow<py::dict>(x);
  if (py::hasattr(x, "keys")) return py::dict(py::reinterpret_borrow<py::object>(x));
  throw py::type_error(std::string("kte: ") + what + " must be a dict from " + of + ", not " +
                       py::repr(x).cast<std::string>());
}

void put_inputs(const kte::runtime_chain& c, kte::runtime_state& s, py::handle inputs) {
  for (const auto& [key, value] : dict_from("inputs", "names to numbers", inputs)) {
    const auto name = key.cast<std::string>();
    const auto k = c.wiring().kind_of(name, false);
    const auto& writers = c.wiring().writers[static_cast<std::size_t>(k)];
    if (k == kte::kind::vector) {
      const auto x = vector_from(name.c_str(), value, 3);
      s.vector(name) = {x[0], x[1], x[2]};
    } else if (k == kte::kind::input) {
      s.input(name) = vector_from(name.c_str(), value, 1)[0];
    } else {
      throw kte::unknown_name("kte: '" + name + "' is " + kte::detail::text_with_article(k) + ", not an input");
    }
    if (writers[static_cast<std::size_t>(c.wiring().find(name, k))] >= 0)
      throw kte::bad_argument("kte: '" + name + "' is not an input: an element writes it");
  }
}

std::vector<std::string> names_from(py::handle names) {
  if (py::isinstance<py::str>(names)) return {names.cast<std::string>()};
  if (!py::hasattr(names, "__iter__"))
    throw py::type_error("kte: names must be a str or a list of them, not " + py::repr(names).cast<std::string>());
  std::vector<std::string> all;
  for (const auto name : names) {
    if (!py::isinstance<py::str>(name))
      throw py::type_error("kte: a name must be a str, not " + py::repr(name).cast<std::string>());
    all.push_back(name.cast<std::string>());
  }
  return all;
}

namespace {

const kte::element_registry& registry() {
  static const auto all = kte::element_registry::standard();
  return all;
}

using connections = std::vector<std::pair<std::string, std::string>>;
using parameters = std::vector<std::pair<std::string, std::vector<double>>>;

std::unique_ptr<kte::kte_map> element_from(py::handle record) {
  const auto [type, ports, values] = record.cast<std::tuple<std::string, connections, parameters>>();
  kte::element_record r{type, 1, {}, {}};
  for (const auto& [role, name] : ports) r.connections.push_back({role, name});
  for (const auto& [name, numbers] : values) r.parameters.push_back({name, numbers});
  return registry().make(r);
}

/// Appends an element, a chain, or a list of such: all of it or nothing.
void append(kte::runtime_chain& c, py::handle part) {
  if (py::isinstance<py::list>(part) || py::isinstance<py::tuple>(part)) {
    kte::runtime_chain longer = c;
    for (const auto each : part) append(longer, each);
    c = std::move(longer);
  } else if (py::hasattr(part, "_record")) {
    c.append(element_from(part.attr("_record")()));
  } else if (py::isinstance<chain_object>(part) || py::hasattr(part, "chain")) {
    c << chain_of(part).chain();
  } else {
    throw py::type_error("kte: a chain is made of elements and chains, not of " + py::repr(part).cast<std::string>());
  }
}

py::list elements_of(const kte::runtime_chain& c) {
  const py::object element = py::module_::import("kte._element").attr("Element");
  py::list all;
  for (const auto& e : kte::record_of(c).elements) {
    py::dict ports, values;
    for (const auto& p : e.connections) ports[py::str(p.role)] = p.name;
    for (const auto& p : e.parameters) values[py::str(p.name)] = p.values;
    all.append(element(e.type, ports, values));
  }
  return all;
}

py::object gravity_of(const kte::runtime_chain& c) {
  return fixed(to_array(Eigen::VectorXd(Eigen::Vector3d(c.gravity().x, c.gravity().y, c.gravity().z))));
}
void set_gravity(kte::runtime_chain& c, py::handle g) {
  const auto x = vector_from("gravity", g, -1);
  if (x.size() != 2 && x.size() != 3)
    throw kte::bad_argument("kte: gravity has " + std::to_string(x.size()) + " numbers, expected x, y, z, or x, y");
  c.gravity(kte::vec3<>{x[0], x[1], x.size() == 3 ? x[2] : 0.0});
}

std::string short_text(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}
std::string text_of(const chain_object& o) {
  const auto& c = o.chain();
  const auto g = c.gravity();
  const auto n = size_of(c);
  std::string s = std::string("<kte.Chain") + (o.compiled() ? ", compiled: " : ": ") + std::to_string(n) +
                  (n == 1 ? " element, " : " elements, ") + std::to_string(c.dofs()) +
                  (c.dofs() == 1 ? " degree of freedom" : " degrees of freedom");
  std::string names;
  for (const auto& e : kte::layout(c)) {
    if (names.size() > 60) {
      names += ", ...";
      break;
    }
    names.append(names.empty() ? "" : ", ").append(e.name);
  }
  if (!names.empty()) s.append(" (").append(names).append(")");
  if (g != kte::vec3<>{})
    s += ", gravity (" + short_text(g.x) + ", " + short_text(g.y) + ", " + short_text(g.z) + ") m/s^2";
  return s + ">";
}
std::vector<std::string> names_of(const kte::runtime_chain& c, std::initializer_list<kte::kind> kinds) {
  std::vector<std::string> all;
  for (const auto k : kinds)
    for (const auto& name : c.wiring().names[static_cast<std::size_t>(k)]) all.push_back(name);
  return all;
}

py::list layout_of(const kte::runtime_chain& c) {
  const py::object entry = py::module_::import("kte._results").attr("Coordinate");
  py::list all;
  for (const auto& e : kte::layout(c))
    all.append(
        entry(e.name, std::string(to_string(e.what)), py::slice(e.q, e.q + e.nq, 1), py::slice(e.v, e.v + e.nv, 1)));
  return all;
}

std::vector<std::string> inputs_of(const kte::runtime_chain& c) {
  std::vector<std::string> all;
  for (const auto& s : c.wiring().signals)
    if (s.u >= 0) all.push_back(c.wiring().names[static_cast<std::size_t>(s.what)][static_cast<std::size_t>(s.slot)]);
  return all;
}

/// Copies and pickles, also of classes of the program.
py::object copies() { return py::module_::import("kte._copies"); }

}  // namespace

py::bytes bytes_of(const kte::runtime_chain& c) { return kte::to_binary(kte::record_of(c)); }
kte::runtime_chain chain_from_bytes(const py::bytes& b) {
  kte::runtime_chain c = kte::to_chain(kte::from_binary(std::string(b), "a pickled chain"), registry());
  return c;
}

void bind_chain(py::module_& m) {
  using namespace py::literals;
  py::class_<chain_object> chain(m, "Chain", R"(Chain(*parts, gravity=None)

A mechanism: elements in order. Each reads frames and coordinates that elements before it write.

    pendulum = kte.Chain(gravity=[0, -9.81, 0])
    pendulum << kte.revolute_joint_2D("q", "base", "joint")
    pendulum << kte.rigid_link_2D("joint", "tip", [0.5, 0]) << kte.inertia_2D("tip", mass=1)

Parts are elements, chains, robots, and lists of such. Gravity is in axes of the bases, m/s^2; without it the chain
takes that of the first part that has one. Threads may share a chain.)");
  chain
      .def(py::init([](const py::args& parts, py::handle gravity) {
             auto c = std::make_unique<chain_object>();
             if (!gravity.is_none()) set_gravity(c->edit(), gravity);
             append(c->edit(), parts);
             return c;
           }),
           py::arg("gravity") = py::none())
      .def(
          "__lshift__",
          [](py::object self, py::handle part) {
            append(self.cast<chain_object&>().edit(), part);
            return self;
          },
          "Appends an element, a chain, or a list of such, and returns the chain. If it is refused, the chain is "
          "unchanged.")
      .def(
          "add",
          [](py::object self, const py::args& parts) {
            append(self.cast<chain_object&>().edit(), parts);
            return self;
          },
          "add(*parts)\n\nAppends elements, chains and lists of such, all or none, and returns the chain.")
      .def_property(
          "gravity", [](const chain_object& c) { return gravity_of(c.chain()); },
          [](chain_object& c, py::handle g) { set_gravity(c.edit(), g); }, "Gravity in axes of the bases, m/s^2.")
      .def_property_readonly(
          "nq", [](const chain_object& c) { return c.chain().nq(); }, "Numbers of a configuration q.")
      .def_property_readonly(
          "nv", [](const chain_object& c) { return c.chain().dofs(); }, "Degrees of freedom: numbers of v, a, tau.")
      .def_property_readonly(
          "elements", [](const chain_object& c) { return elements_of(c.chain()); },
          "The elements, in order, as `Element`s.")
      .def_property_readonly(
          "coordinates",
          [](const chain_object& c) {
            std::vector<std::string> all;
            for (const auto& e : kte::layout(c.chain())) all.push_back(e.name);
            return all;
          },
          "Names of the coordinates that are degrees of freedom, in the order of q and v.")
      .def_property_readonly(
          "frames",
          [](const chain_object& c) {
            return names_of(c.chain(), {kte::kind::frame_2D, kte::kind::frame_3D});
          },
          "Names of all frames.")
      .def_property_readonly(
          "inputs", [](const chain_object& c) { return inputs_of(c.chain()); },
          "Names of the signals that no element writes.")
      .def_property_readonly(
          "layout", [](const chain_object& c) { return layout_of(c.chain()); },
          "Where each coordinate is in q and v: a list of `Coordinate(name, kind, q, v)`, with slices q and v.")
      .def(
          "check", [](const chain_object& c) { return kte::check_chain(c.chain()); },
          "check()\n\nWhat is unusual about the chain, as sentences.")
      .def(
          "parameters",
          [](const chain_object& c) {
            py::dict all;
            for (const auto& [path, value] : kte::parameters_by_path(c.chain())) all[py::str(path)] = value;
            return all;
          },
          R"(parameters()

The numbers of all elements, a dict from paths as "tool/mass" and "tool/com/x", those of sweeps, to values in SI units,
and gravity. Parameters that no path names alone, as those of two equal springs between the same frames, and tables are
not among them.)")
      .def(
          "with_parameters",
          [](const chain_object& c, py::handle values) {
            std::vector<std::string> paths;
            std::vector<double> numbers;
            for (const auto& [path, value] : dict_from("values", "paths to numbers", values)) {
              paths.push_back(path.cast<std::string>());
              numbers.push_back(number_from(paths.back().c_str(), value));
            }
            return std::make_unique<chain_object>(kte::varied_chain(c.chain(), paths, registry()).with(numbers));
          },
          "with_parameters(values)\n\nA copy of the chain with other values, a dict from paths of `parameters` to "
          "numbers. Elements refuse the values that they refuse when they are made.",
          "values"_a)
      .def("__len__", [](const chain_object& c) { return size_of(c.chain()); })
      .def("__repr__", [](const chain_object& c) { return text_of(c); })
      .def("__eq__",
           [](const chain_object& a, py::handle b) {
             return py::isinstance<chain_object>(b) &&
                    kte::record_of(a.chain()) == kte::record_of(b.cast<const chain_object&>().chain());
           })
      .def("__copy__", [](py::handle c) { return copies().attr("copied")(c); })
      .def("__deepcopy__", [](py::handle c, py::handle memo) { return copies().attr("copied")(c, memo); })
      .def("__reduce__", [](py::handle c) { return copies().attr("reduced")(c); })
      .def("_become", &chain_object::become)
      .def("_pickle", [](const chain_object& c) {
        return py::make_tuple(bytes_of(c.chain()),
                              c.compiled() ? py::cast(c.compiled()->frames()) : py::object(py::none()));
      });
  chain.attr("__hash__") = py::none();
  m.def(
      "_chain_from",
      [](const py::bytes& bytes, const std::optional<std::vector<std::string>>& compiled_frames) {
        auto made = std::make_unique<chain_object>(chain_from_bytes(bytes));
        if (!compiled_frames) return made;
        std::shared_ptr<const compiled_functions> functions;
        {
          const py::gil_scoped_release without;
          functions = compile_chain(made->chain(), *compiled_frames);
        }
        made->compiled(std::move(functions));
        return made;
      },
      "bytes"_a, "compiled_frames"_a);
  m.def(
      "_check_element",
      [](py::handle record) {
        try {
          static_cast<void>(element_from(record));
        } catch (const kte::bad_file& e) {  // the record is not from a file
          throw kte::bad_parameter(e.what());
        }
      },
      "record"_a);
  m.def(
      "element_types", [] { return registry().types(); }, "element_types()\n\nThe names of all types of elements.");
}

}  // namespace kte_python

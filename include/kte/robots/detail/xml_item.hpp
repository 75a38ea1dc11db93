#pragma once

#include <kte/detail/interruption.hpp>
#include <kte/io/numbers.hpp>
#include <kte/io/source_text.hpp>
#include <kte/math/vec.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/detail/xml_defaults.hpp>
#include <kte/robots/detail/xml_title.hpp>

#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>

namespace kte::detail {

class xml_children;

/// An element of an XML file, with errors that name the place, the element and the reason. Numbers are read by
/// std::from_chars, whatever the locale.
class xml_item {
 public:
  xml_item(const xml_node& e, robot_description& d) : e_(&e), d_(&d) {}

  /// The element with the defaults at a moment; its empty attributes count as missing.
  xml_item with(xml_defaults& defaults, xml_defaults::moment at) const {
    xml_item x = *this;
    x.defaults_ = &defaults, x.at_ = at;
    return x;
  }

  const xml_node& node() const { return *e_; }
  std::string_view name() const { return e_->name; }
  int line() const { return e_->line; }
  const std::string& file() const { return e_->file; }
  bool has(const char* attribute) const { return find(attribute) != nullptr; }

  /// Throws `bad_file`: "kte: arm.urdf:37: joint 'elbow': why", or for an element without a name "joint 'elbow':
  /// <origin>: why".
  [[noreturn]] void fail(const std::string& why) const {
    raise<bad_file>("kte: " + place_text(file().empty() ? d_->source : file(), line()) + title() + ": " + why);
  }
  void warn(const std::string& what) const { d_->warnings.push_back({line(), title() + ": " + what, file()}); }
  /// Adds a warning about a difference in motion from the robot of the file.
  void moves_differently(const std::string& what) const {
    d_->warnings.push_back({line(), title() + ": " + what, file(), true});
  }
  void not_read(const std::string& what) const { d_->not_read.push_back({line(), title() + ": " + what, file()}); }

  std::string title() const { return title_of(*e_); }

  std::string text_or(const char* attribute, const char* other) const {
    const auto* t = find(attribute);
    return t != nullptr ? *t : other;
  }
  /// The text of an attribute, which must not be missing or empty.
  const std::string& text(const char* attribute) const {
    const auto* t = find(attribute);
    if (t == nullptr) fail(std::string("has no ") + attribute);
    if (t->empty()) fail(std::string("its ") + attribute + " is empty");
    return *t;
  }

  /// A list of finite numbers of any length.
  std::vector<double> list(const char* attribute) const { return list_of(text(attribute), attribute); }
  std::vector<double> list_of(std::string_view t, const char* what) const {
    auto all = any_list(t, what);
    for (const double x : all)
      if (!std::isfinite(x)) fail(std::string(what) + " must be finite, got '" + excerpt(t) + "'");
    return all;
  }
  /// The numbers of an attribute; up to `most`, missing ones at the end are those of its class, then those of the
  /// enclosing classes.
  std::vector<double> completed_list(const char* attribute, std::size_t most) const {
    auto all = list(attribute);
    if (defaults_ != nullptr && all.size() < most)
      defaults_->each(attribute, at_, [&](const std::string& usual) {
        const auto more = list_of(usual, attribute);
        for (std::size_t i = all.size(); i < more.size(); ++i) all.push_back(more[i]);
        return all.size() < most;
      });
    return all;
  }
  /// A list of numbers that may be infinite.
  std::vector<double> limits_of(std::string_view t, const char* what) const { return any_list(t, what); }
  double number(const char* attribute) const { return one(list(attribute), attribute); }
  double number_or(const char* attribute, double other) const { return has(attribute) ? number(attribute) : other; }
  double not_negative(const char* attribute) const {
    const double x = number(attribute);
    if (!(x >= 0)) fail(std::string(attribute) + " must not be negative, got " + detail::number(x));
    return x;
  }
  double not_negative_or(const char* attribute, double other) const {
    return has(attribute) ? not_negative(attribute) : other;
  }
  /// A whole number of a range, by default those of Integer.
  template <class Integer = int>
  Integer whole_or(const char* attribute, Integer other, double least = double{(std::numeric_limits<Integer>::min)()},
                   double most = double{(std::numeric_limits<Integer>::max)()}) const {
    return has(attribute) ? static_cast<Integer>(whole(number(attribute), attribute, least, most)) : other;
  }
  /// x, which must be a whole number from `least` to `most`.
  double whole(double x, const char* what, double least, double most) const {
    if (!(x >= least && x <= most) || x != std::floor(x))
      fail(std::string(what) + " must be a whole number from " + detail::number(least) + " to " + detail::number(most) +
           ", got " + detail::number(x));
    return x;
  }
  /// A number that may be infinite.
  double limit(const char* attribute) const {
    const double x = one(any_list(text(attribute), attribute), attribute);
    if (std::isnan(x)) fail(std::string(attribute) + " is not a number");
    return x;
  }
  vec3<> vector(const char* attribute) const { return three(list(attribute), attribute); }
  vec3<> vector_or(const char* attribute, const vec3<>& other) const {
    return has(attribute) ? vector(attribute) : other;
  }
  vec3<> three(const std::vector<double>& x, const char* what) const {
    if (x.size() != 3) fail(std::string(what) + " must have three numbers, got " + std::to_string(x.size()));
    return {x[0], x[1], x[2]};
  }
  double one(const std::vector<double>& x, const char* what) const {
    if (x.size() != 1) fail(std::string(what) + " must be one number, got " + std::to_string(x.size()));
    return x[0];
  }
  /// The text between the tags.
  const std::string& content() const { return e_->text; }

  /// The children of a name, or all, one after another.
  xml_children children(std::string_view of = {}) const;
  /// The child of a name; throws if there are several.
  std::optional<xml_item> child(std::string_view of) const;
  xml_item needed_child(const char* of) const {
    const auto c = child(of);
    if (!c) fail(std::string("has no <") + of + ">");
    return *c;
  }

  /// Notes all attributes and children other than these as not read, and those of its defaults once, where they are
  /// written.
  using names = std::initializer_list<std::string_view>;
  void only(const names& elements, const names& attributes) const {
    const auto in = [](const names& all, std::string_view x) {
      for (const auto n : all)
        if (same_name(n, x)) return true;
      return false;
    };
    for (const auto& c : e_->children)
      if (!in(elements, c.name)) xml_item(c, *d_).not_read("not read");
    for (const auto& [attribute, value] : e_->attributes)
      if (!in(attributes, attribute) && !attribute.starts_with("xmlns") && (defaults_ == nullptr || !value.empty()))
        not_read("its " + excerpt(attribute) + " is not read");
    if (defaults_ == nullptr) return;
    for (const auto* x : defaults_->take_writers()) xml_item(*x, *d_).only(elements, attributes);
  }

 private:
  std::vector<double> any_list(std::string_view t, const char* what) const {
    std::vector<double> all;
    all.reserve(4);
    const char* why = t.find('+') == t.npos ? text_to_numbers(t, all) : text_to_numbers(without_plus(t), all);
    if (why == nullptr) return all;
    if (t.find("${") != t.npos) why = "is an expression of xacro: run xacro, and read the file that it writes";
    fail(std::string(what) + " '" + excerpt(t) + "' " + why);
  }
  /// The text without plus signs of numbers, which std::from_chars does not accept.
  static std::string without_plus(std::string_view t) {
    std::string plain(t);
    for (std::size_t i = 0; i < plain.size(); ++i)
      if (plain[i] == '+' && (i == 0 || is_blank(plain[i - 1])) && i + 1 < plain.size() && plain[i + 1] != '-')
        plain[i] = ' ';
    return plain;
  }

  const std::string* find(std::string_view attribute) const {
    for (const auto& [key, value] : e_->attributes)
      if (same_name(key, attribute) && (defaults_ == nullptr || !value.empty())) return &value;
    return defaults_ != nullptr ? defaults_->find(attribute, at_) : nullptr;
  }

  const xml_node* e_;
  robot_description* d_;
  xml_defaults* defaults_ = nullptr;
  xml_defaults::moment at_ = 0;
};

/// The children of an element of one name, or all.
class xml_children {
  using node = std::vector<xml_node>::const_iterator;

 public:
  class iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = xml_item;
    using difference_type = std::ptrdiff_t;
    using pointer = const xml_item*;
    using reference = xml_item;

    iterator(const xml_children& of, node at) : of_(&of), at_(at) { find(); }
    xml_item operator*() const { return {*at_, of_->d_}; }
    iterator& operator++() {
      ++at_, find();
      return *this;
    }
    bool operator==(const iterator& o) const { return at_ == o.at_; }

   private:
    void find() {
      while (at_ != of_->all_.end() && !of_->name_.empty() && !same_name(of_->name_, at_->name)) ++at_;
    }
    const xml_children* of_;
    node at_;
  };

  xml_children(const std::vector<xml_node>& all, std::string_view name, robot_description& d)
      : all_(all), name_(name), d_(d) {}
  iterator begin() const { return {*this, all_.begin()}; }
  iterator end() const { return {*this, all_.end()}; }
  bool empty() const { return begin() == end(); }
  /// The first, if there is one.
  std::optional<xml_item> first() const { return empty() ? std::nullopt : std::optional(*begin()); }
  /// The second, if there is one.
  std::optional<xml_item> second() const {
    auto at = begin();
    if (at == end() || ++at == end()) return {};
    return *at;
  }
  std::vector<xml_item> list() const { return {begin(), end()}; }

 private:
  const std::vector<xml_node>& all_;
  std::string_view name_;
  robot_description& d_;
};

inline xml_children xml_item::children(std::string_view of) const { return {e_->children, of, *d_}; }
inline std::optional<xml_item> xml_item::child(std::string_view of) const {
  const auto all = children(of);
  if (const auto again = all.second()) again->fail("occurs twice");
  return all.first();
}

}  // namespace kte::detail

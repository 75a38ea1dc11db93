#pragma once

#include <kte/runtime_chain/topology.hpp>

namespace kte {

/// An item of a runtime chain, looked up once: `const auto tool = arm.frame("tool")`. Calls accept it instead of a
/// name, and check that it belongs to the chain or to a copy. Appending to the chain or changing its gravity
/// invalidates handles.
class handle {
 public:
  /// The kind of the item: a coordinate, a frame, an input, ...
  [[nodiscard]] kind what() const { return what_; }
  /// Its index among items of its kind.
  [[nodiscard]] int index() const { return index_; }

 private:
  friend class runtime_chain;
  friend class name_or_handle;
  handle(kind what, int index, std::shared_ptr<const char> layout)
      : what_(what), index_(index), layout_(std::move(layout)) {}
  kind what_;
  int index_;
  std::shared_ptr<const char> layout_;
};

/// An argument that is a name or a handle.
class name_or_handle {
 public:
  template <text_type Text>
  name_or_handle(const Text& name) : name_(name) {}         // NOLINT(google-explicit-constructor)
  name_or_handle(const handle& known) : handle_(&known) {}  // NOLINT(google-explicit-constructor)

  /// The kind and index of a frame of the chain. Throws `unknown_name`, or `bad_argument` for a handle of another
  /// chain.
  std::pair<kind, int> frame_of(const topology& t) const {
    if (handle_ == nullptr) return t.frame(name_);
    check(t);
    if (!is_frame(handle_->what_))
      throw bad_argument("kte: this is the handle of " + text(handle_->what_) + ", not of a frame");
    return {handle_->what_, handle_->index_};
  }
  /// The index of an item of kind k. Throws `unknown_name`, or `bad_argument` for a handle of another chain.
  int find(const topology& t, kind k) const {
    if (handle_ == nullptr) return t.find(name_, k);
    check(t);
    if (handle_->what_ != k)
      throw bad_argument("kte: this is the handle of " + text(handle_->what_) + ", not of " + text(k));
    return handle_->index_;
  }

 private:
  static std::string text(kind k) { return detail::text_with_article(k); }
  void check(const topology& t) const {
    if (handle_->layout_ != t.layout)
      throw bad_argument(
          "kte: this handle is of another chain, or from before the last element was appended or gravity was changed");
  }
  std::string_view name_;
  const handle* handle_ = nullptr;
};

/// A type that names an item of a runtime chain: a text or a handle.
template <class T>
concept names_something = text_type<T> || std::is_same_v<T, handle>;

}  // namespace kte

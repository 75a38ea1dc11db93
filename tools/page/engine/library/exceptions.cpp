/// Exceptions of C++ by those of WebAssembly, which Debian's libc++abi for it leaves out: the functions that clang
/// calls (Itanium C++ ABI: Exception Handling, level II, and "Exception handling tables" of LLVM for WebAssembly).
/// There is one thread and no foreign exception, and every exception is caught: engine.cpp catches all.

#include <cstdint>
#include <cstdlib>
#include <new>
#include <typeinfo>

namespace __cxxabiv1 {

/// How libc++abi declares the type information of classes, which says whether one is a base of another.
class __shim_type_info : public std::type_info {
 public:
  ~__shim_type_info() override;
  virtual void noop1() const;
  virtual void noop2() const;
  virtual bool can_catch(const __shim_type_info* thrown, void*& object) const = 0;
};

}  // namespace __cxxabiv1

namespace {

/// Stands before the object that is thrown. An exception is known by the address of the object.
struct header {
  const std::type_info* type;
  void* (*destroy)(void*);
  int handlers;   ///< that hold it; negative while it is thrown again
  header* below;  ///< the one caught before it
  void* seen;     ///< as the handler sees it: the base that it catches
  int padding[3];
};
static_assert(sizeof(header) % 16 == 0);

header* caught = nullptr;

header* header_of(void* object) { return static_cast<header*>(object) - 1; }

/// LEB128, the sign extended or not.
std::uint32_t read_unsigned(const std::uint8_t*& p) {
  std::uint32_t x = 0;
  int shift = 0;
  for (;; shift += 7) {
    const std::uint8_t byte = *p++;
    x |= static_cast<std::uint32_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return x;
  }
}
std::int32_t read_signed(const std::uint8_t*& p) {
  std::uint32_t x = 0;
  for (int shift = 0;;) {
    const std::uint8_t byte = *p++;
    x |= static_cast<std::uint32_t>(byte & 0x7f) << shift;
    shift += 7;
    if (byte < 0x80) return static_cast<std::int32_t>(shift < 32 && (byte & 0x40) ? x | (~0U << shift) : x);
  }
}

constexpr std::uint8_t omitted = 0xff;

/// The number of the first handler at a landing pad that catches the exception, or 0.
int handler_of(header& e, const std::uint8_t* table, std::uint32_t pad) {
  const std::uint8_t* p = table;
  if (*p++ != omitted) std::abort();  // a start of landing pads: there is none
  const void* const* types = nullptr;
  if (*p++ != omitted) {
    const std::uint32_t offset = read_unsigned(p);
    types = reinterpret_cast<const void* const*>(p + offset);
  }
  ++p;  // the encoding of call sites: LEB128
  const std::uint32_t length = read_unsigned(p);
  const std::uint8_t* const actions = p + length;
  std::uint32_t action = 0;
  for (std::uint32_t i = 0; i <= pad; ++i) read_unsigned(p), action = read_unsigned(p);
  if (action == 0) return 0;
  for (p = actions + (action - 1);;) {
    const std::int32_t number = read_signed(p);
    if (number > 0) {
      const auto* type = static_cast<const __cxxabiv1::__shim_type_info*>(*(types - number));
      void* object = &e + 1;
      if (type == nullptr || type->can_catch(static_cast<const __cxxabiv1::__shim_type_info*>(e.type), object)) {
        e.seen = object;
        return number;
      }
    }
    const std::uint8_t* const here = p;
    const std::int32_t next = read_signed(p);
    if (next == 0) return 0;
    p = here + next;
  }
}

}  // namespace

extern "C" {

/// Which landing pad has caught, and which of its handlers takes it.
struct {
  std::uint32_t pad;
  const std::uint8_t* table;
  std::int32_t handler;
} __wasm_lpad_context;

int _Unwind_CallPersonality(void* object) {
  auto& c = __wasm_lpad_context;
  c.handler = handler_of(*header_of(object), c.table, c.pad);
  return 0;
}
int __gxx_wasm_personality_v0() { std::abort(); }

void* __cxa_allocate_exception(std::size_t size) {
  auto* const e = static_cast<header*>(std::malloc(sizeof(header) + size));
  if (e == nullptr) std::abort();
  return e + 1;
}
void __cxa_free_exception(void* object) { std::free(header_of(object)); }

[[noreturn]] void __cxa_throw(void* object, std::type_info* type, void* (*destroy)(void*)) {
  *header_of(object) = {type, destroy, 0, nullptr, object, {}};
  __builtin_wasm_throw(0, object);
}
void* __cxa_get_exception_ptr(void* object) { return header_of(object)->seen; }
void* __cxa_begin_catch(void* object) {
  header* const e = header_of(object);
  e->handlers = (e->handlers < 0 ? -e->handlers : e->handlers) + 1;
  if (caught != e) e->below = caught, caught = e;
  return e->seen;
}
void __cxa_end_catch() {
  header* const e = caught;
  if (e->handlers < 0) {  // thrown again
    if (++e->handlers == 0) caught = e->below;
    return;
  }
  if (--e->handlers != 0) return;
  caught = e->below;
  if (e->destroy != nullptr) e->destroy(e + 1);
  std::free(e);
}
[[noreturn]] void __cxa_rethrow() {
  caught->handlers = -caught->handlers;
  __builtin_wasm_throw(0, caught + 1);
}

}  // extern "C"

// Those of libc++abi give null pointers.
void* operator new(std::size_t size) {
  void* const p = std::malloc(size == 0 ? 1 : size);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

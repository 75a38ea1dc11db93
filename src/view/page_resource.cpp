#include "page_resource.hpp"

// The file itself, whose path the build gives as KTE_PAGE_FILE, goes into the library unchanged.
#if defined(__APPLE__)
#  define KTE_PAGE_SYMBOL(name) "_" name
asm(".const_data\n");
#else
#  define KTE_PAGE_SYMBOL(name) name
asm(".pushsection .rodata\n");
#endif
asm(".globl " KTE_PAGE_SYMBOL("kte_view_page_begin") "\n"
    ".globl " KTE_PAGE_SYMBOL("kte_view_page_end") "\n"
    ".balign 16\n"
    KTE_PAGE_SYMBOL("kte_view_page_begin") ":\n"
    ".incbin \"" KTE_PAGE_FILE "\"\n"
    KTE_PAGE_SYMBOL("kte_view_page_end") ":\n"
    ".byte 0\n");
#if defined(__APPLE__)
asm(".text\n");
#else
asm(".popsection\n");
#endif

extern "C" const char kte_view_page_begin[], kte_view_page_end[];

namespace kte::view {

std::string_view page_resource() {
  return {kte_view_page_begin, static_cast<std::size_t>(kte_view_page_end - kte_view_page_begin)};
}

}  // namespace kte::view

#include "programs/cli/large_arrays.h"

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t large_bytes = std::size_t{4} << 20U;
constexpr std::size_t page_bytes = std::size_t{2} << 20U;

void* allocate(std::size_t bytes) {
  if (bytes < large_bytes) return std::malloc(bytes > 0 ? bytes : 1);
  const std::size_t pages = (bytes + page_bytes - 1) / page_bytes;
  if (pages * page_bytes < bytes) return nullptr;
  void* const memory = std::aligned_alloc(page_bytes, pages * page_bytes);
  if (memory != nullptr) ::madvise(memory, pages * page_bytes, MADV_HUGEPAGE);  // where there are none, the array has small pages
  return memory;
}

}  // namespace

// Replaces the operator of the standard library, from which its array form and std::vector get their memory.
void* operator new(std::size_t bytes) {
  while (true) {
    if (void* const memory = allocate(bytes)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t /*bytes*/) noexcept {
  std::free(memory);
}

namespace sunfleck {

void use_huge_pages() {}

}  // namespace sunfleck

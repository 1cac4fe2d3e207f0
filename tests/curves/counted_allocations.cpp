#include "counted_allocations.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

// In a file of its own: a compiler that sees both sides takes the pairs for mismatched.

namespace {

std::atomic<std::size_t> allocation_count = 0, held = 0;

void* counted(std::size_t size, std::size_t alignment) {
  ++allocation_count;
  const std::size_t least = size > 0 ? size : 1;
  if (void* memory = std::aligned_alloc(alignment, (least + alignment - 1) / alignment * alignment)) {
    held += malloc_usable_size(memory);
    return memory;
  }
  throw std::bad_alloc();
}

void give_back(void* memory) noexcept {
  held -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

std::size_t tweenfall::test::bytes_held() noexcept {
  return held;
}

std::size_t tweenfall::test::allocations() noexcept {
  return allocation_count;
}

void* operator new(std::size_t size) {
  return counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
// A stable sort allocates by this one, and frees by the plain delete.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted(size, alignof(std::max_align_t));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  give_back(memory);
}

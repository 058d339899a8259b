// An array of many elements that are filled at once, by all cores: its memory is not touched before, and
// comes in huge pages where the system has them, since taking 40 MB page by page costs more than filling
// them.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace penumbra::detail {

template <class T>
class LargeArray {
  static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_destructible_v<T>);

 public:
  LargeArray() = default;
  explicit LargeArray(std::size_t size) : size_(size) {
    constexpr std::size_t kHugePage = std::size_t{1} << 21, kSmall = 4096;
    const std::size_t wanted = size * sizeof(T), page = wanted >= kHugePage ? kHugePage : kSmall;
    const std::size_t bytes = (wanted + page - 1) / page * page;
    memory_.reset(static_cast<T*>(std::aligned_alloc(page, bytes)));
    if (!memory_ && bytes > 0) throw std::bad_alloc();
#if defined(__linux__)
    if (page == kHugePage) madvise(memory_.get(), bytes, MADV_HUGEPAGE);  // a hint; it may be refused
#endif
  }
  T* data() {
    return memory_.get();
  }
  const T* data() const {
    return memory_.get();
  }
  std::size_t size() const {
    return size_;
  }
  T& operator[](std::size_t i) {
    return memory_.get()[i];
  }
  const T& operator[](std::size_t i) const {
    return memory_.get()[i];
  }
  const T* begin() const {
    return data();
  }
  const T* end() const {
    return data() + size_;
  }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> memory_;
  std::size_t size_ = 0;
};

}  // namespace penumbra::detail

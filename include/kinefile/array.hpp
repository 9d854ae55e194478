// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#pragma GCC visibility push(default)

namespace kinefile {

namespace detail {

struct Storage;

/// Memory for at least `num_bytes` bytes, 64-byte aligned, not filled. Its reference count is 1.
Storage* allocate_storage(std::size_t num_bytes);
/// Memory of the caller, kept alive by `owner`. Its reference count is 1.
Storage* adopt_storage(void* data, std::size_t num_bytes, std::shared_ptr<const void> owner,
                       bool is_writable);
void retain_storage(Storage* storage) noexcept;
void release_storage(Storage* storage) noexcept;
void* storage_data(const Storage* storage) noexcept;
std::size_t storage_capacity(const Storage* storage) noexcept;
/// Whether only one array holds this memory and may write it.
bool is_exclusive(const Storage* storage) noexcept;
bool is_exposed(const Storage* storage) noexcept;
void expose_storage(Storage* storage) noexcept;

}  // namespace detail

/// A contiguous array of numbers. Copies share their memory until one of them is written, so that a
/// copy costs nothing. Memory is not filled with zeros. Memory of others (a NumPy array, the
/// browser's heap) can be adopted with its owner.
///
/// Reading is const throughout. Writing starts with one explicit call, `mutate`, which copies the
/// numbers if other arrays share them. Memory that is handed out with `expose`, or adopted as
/// writable, is exposed: code outside may write it at any time, so copies of such an array are
/// deep.
///
/// Memory that an array allocates is 64-byte aligned (large blocks request huge pages). Adopted
/// memory and rows within an array are not aligned, so no code may rely on alignment.
///
/// Threads: const access and copying from several threads at once is safe; writing needs an array
/// that no other thread uses (copies that share memory count as other arrays).
/// \tparam T  trivially copyable
template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64);

 public:
  using value_type = T;
  using const_iterator = const T*;

  Array() = default;
  /// `size` uninitialised elements.
  explicit Array(std::size_t size) { resize(size); }
  /// `size` elements, all equal to `value`.
  Array(std::size_t size, T value) { assign(size, value); }
  Array(std::initializer_list<T> values) { append({values.begin(), values.size()}); }
  /// A copy of these elements.
  explicit Array(std::span<const T> values) { append(values); }
  Array(const std::vector<T>& values) { append(values); }

  Array(const Array& other) : Array() { *this = other; }
  Array(Array&& other) noexcept { swap(other); }
  Array& operator=(const Array& other) {
    if (this == &other) return *this;
    if (other.storage_ != nullptr && detail::is_exposed(other.storage_)) {
      Array copy(std::span<const T>(other.data(), other.size()));
      swap(copy);
      return *this;
    }
    if (other.storage_ != nullptr) detail::retain_storage(other.storage_);
    release();
    storage_ = other.storage_;
    data_ = other.data_;
    size_ = other.size_;
    return *this;
  }
  Array& operator=(Array&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Array() { release(); }

  /// An array over memory of the caller, which is only read; a write copies it first.
  static Array adopt(std::span<const T> values, std::shared_ptr<const void> owner) {
    // Never written: storage that is not writable is never exclusive.
    return Array(const_cast<T*>(values.data()), values.size(), std::move(owner), false);
  }
  /// An array over memory of the caller, which is written in place. It is exposed.
  static Array adopt_writable(std::span<T> values, std::shared_ptr<const void> owner) {
    return Array(values.data(), values.size(), std::move(owner), true);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Null for an array that never had an element.
  const T* data() const { return data_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  const T& front() const { return data_[0]; }
  const T& back() const { return data_[size_ - 1]; }

  /// The elements, for writing. Copies them first if other arrays share them. The span is valid
  /// until the array is copied, resized or destroyed.
  std::span<T> mutate() {
    make_exclusive(size_);
    return {data_, size_};
  }

  /// As `mutate`, but for a view that is kept: the array is exposed from now on.
  std::span<T> expose() {
    const std::span<T> values = mutate();
    if (storage_ != nullptr) detail::expose_storage(storage_);
    return values;
  }

  /// Reserves memory for `size` elements in total.
  void reserve(std::size_t size) {
    if (size > capacity()) make_exclusive(size);
  }
  /// Changes the number of elements; new elements are uninitialised.
  void resize(std::size_t size) {
    if (size > size_) grow(size - size_);
    size_ = size;
  }
  void clear() { resize(0); }
  void assign(std::size_t size, T value) {
    resize(size);
    const std::span<T> values = mutate();
    std::fill(values.begin(), values.end(), value);
  }
  /// Adds `count` uninitialised elements, which the caller writes. The total time of many calls is
  /// linear in the number of elements.
  std::span<T> grow(std::size_t count) {
    const std::size_t needed = size_ + count;
    make_exclusive(needed > capacity() ? std::max(needed, size_ + size_ / 2) : needed);
    size_ = needed;
    return {data_ + (needed - count), count};
  }
  /// Adds elements. They may be this array's own.
  void append(std::span<const T> values) {
    if (values.empty()) return;
    Array held;
    if (values.data() >= begin() && values.data() < end()) held = *this;  // keeps them alive
    const std::span<T> added = grow(values.size());
    std::copy(values.begin(), values.end(), added.begin());
  }
  void append(std::initializer_list<T> values) { append(std::span(values.begin(), values.size())); }
  void push_back(T value) { grow(1)[0] = value; }

  void swap(Array& other) noexcept {
    std::swap(storage_, other.storage_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  friend bool operator==(const Array& a, const Array& b) {
    return a.size_ == b.size_ && std::equal(a.begin(), a.end(), b.begin());
  }

 private:
  Array(T* data, std::size_t size, std::shared_ptr<const void> owner, bool is_writable)
      : storage_(detail::adopt_storage(data, size * sizeof(T), std::move(owner), is_writable)),
        data_(data),
        size_(size) {}

  std::size_t capacity() const {
    return storage_ == nullptr ? 0 : detail::storage_capacity(storage_) / sizeof(T);
  }
  /// Gets memory for `size` elements that no other array shares, and keeps the current elements.
  void make_exclusive(std::size_t size) {
    if (storage_ == nullptr && size == 0) return;
    if (storage_ != nullptr && size <= capacity() && detail::is_exclusive(storage_)) return;
    detail::Storage* made = detail::allocate_storage(size * sizeof(T));
    T* data = static_cast<T*>(detail::storage_data(made));
    std::copy(begin(), end(), data);
    release();
    storage_ = made;
    data_ = data;
  }
  void release() {
    if (storage_ != nullptr) detail::release_storage(storage_);
    storage_ = nullptr;
    data_ = nullptr;
  }

  detail::Storage* storage_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Rows of an array, for writing: see `Clip::mutate`.
struct Rows {
  std::span<double> values;  ///< [row][column]
  std::size_t width = 0;

  std::span<double> operator[](std::size_t row) const { return values.subspan(row * width, width); }
};

}  // namespace kinefile

#pragma GCC visibility pop

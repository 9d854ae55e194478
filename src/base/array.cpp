// SPDX-License-Identifier: MIT
#include "kinefile/array.hpp"

#include <atomic>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace kinefile::detail {
namespace {

constexpr std::size_t kAlignment = 64;
/// From this size on, memory is aligned to huge pages, and huge pages are requested from the
/// system.
constexpr std::size_t kHugePage = std::size_t{2} << 20;

std::size_t alignment_of(std::size_t num_bytes) {
  return num_bytes >= kHugePage ? kHugePage : kAlignment;
}

void* allocate(std::size_t num_bytes) {
  void* data = ::operator new(num_bytes, std::align_val_t(alignment_of(num_bytes)));
#if defined(__linux__)
  if (num_bytes >= kHugePage) ::madvise(data, num_bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  return data;
}

}  // namespace

struct Storage {
  std::atomic<std::size_t> num_holders{1};
  void* data = nullptr;
  std::size_t num_bytes = 0;
  std::shared_ptr<const void> owner;  ///< of adopted memory
  bool is_adopted = false;
  bool is_writable = true;
  std::atomic<bool> is_exposed{false};
};

Storage* allocate_storage(std::size_t num_bytes) {
  auto storage = std::make_unique<Storage>();
  storage->data = allocate(num_bytes);
  storage->num_bytes = num_bytes;
  return storage.release();
}

Storage* adopt_storage(void* data, std::size_t num_bytes, std::shared_ptr<const void> owner,
                       bool is_writable) {
  auto storage = std::make_unique<Storage>();
  storage->data = data;
  storage->num_bytes = num_bytes;
  storage->owner = std::move(owner);
  storage->is_adopted = true;
  storage->is_writable = is_writable;
  storage->is_exposed.store(is_writable, std::memory_order_relaxed);
  return storage.release();
}

void retain_storage(Storage* storage) noexcept {
  storage->num_holders.fetch_add(1, std::memory_order_relaxed);
}

void release_storage(Storage* storage) noexcept {
  if (storage->num_holders.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  if (!storage->is_adopted) {
    ::operator delete(storage->data, std::align_val_t(alignment_of(storage->num_bytes)));
  }
  delete storage;
}

void* storage_data(const Storage* storage) noexcept { return storage->data; }

std::size_t storage_capacity(const Storage* storage) noexcept { return storage->num_bytes; }

bool is_exclusive(const Storage* storage) noexcept {
  // Acquire: threads that released the memory have finished reading it.
  return storage->is_writable && storage->num_holders.load(std::memory_order_acquire) == 1;
}

bool is_exposed(const Storage* storage) noexcept {
  return storage->is_exposed.load(std::memory_order_acquire);
}

void expose_storage(Storage* storage) noexcept {
  storage->is_exposed.store(true, std::memory_order_release);
}

}  // namespace kinefile::detail

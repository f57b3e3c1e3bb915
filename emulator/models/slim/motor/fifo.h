// A first-in, first-out queue of fixed length. It is a value without pointers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::emulator::models::slim {

template <class T, std::size_t n>
class Fifo {
 public:
  /// Compares the items, regardless of their positions in the array.
  bool operator==(const Fifo& other) const {
    if (count_ != other.count_) return false;
    for (std::size_t i = 0; i < count_; ++i) {
      if (!((*this)[i] == other[i])) return false;
    }
    return true;
  }

  static constexpr std::size_t capacity() { return n; }

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }

  /// `i` must be < size(). 0 is the head.
  T& operator[](std::size_t i) { return items_[(head_ + i) % n]; }
  const T& operator[](std::size_t i) const { return items_[(head_ + i) % n]; }

  /// There must be room: size() < n.
  void push(const T& item) {
    items_[(head_ + count_) % n] = item;
    ++count_;
  }
  void pop() {
    items_[head_] = T{};
    head_ = static_cast<std::uint8_t>((head_ + 1) % n);
    --count_;
  }
  /// Keeps the first `kept` items.
  void truncate(std::size_t kept) {
    while (count_ > kept) {
      --count_;
      (*this)[count_] = T{};
    }
  }
  template <class Predicate>
  void erase_if(Predicate gone) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (gone((*this)[i])) continue;
      if (kept != i) (*this)[kept] = (*this)[i];
      ++kept;
    }
    truncate(kept);
  }

 private:
  static_assert(n > 0 && n < 128);
  std::array<T, n> items_{};
  std::uint8_t head_ = 0;
  std::uint8_t count_ = 0;
};

}  // namespace understudy::emulator::models::slim

// A queue with contiguous elements: a vector whose first elements may already have been removed.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace understudy {

template <class T>
class Queue {
 public:
  using value_type = T;
  using iterator = typename std::vector<T>::iterator;
  using const_iterator = typename std::vector<T>::const_iterator;

  bool empty() const { return first_ == values_.size(); }
  std::size_t size() const { return values_.size() - first_; }
  T& operator[](std::size_t number) { return values_[first_ + number]; }
  const T& operator[](std::size_t number) const { return values_[first_ + number]; }
  T& front() { return values_[first_]; }
  const T& front() const { return values_[first_]; }
  const T& back() const { return values_.back(); }
  iterator begin() { return values_.begin() + static_cast<std::ptrdiff_t>(first_); }
  iterator end() { return values_.end(); }
  const_iterator begin() const { return values_.begin() + static_cast<std::ptrdiff_t>(first_); }
  const_iterator end() const { return values_.end(); }
  std::span<const T> values() const { return std::span(values_).subspan(first_); }

  /// Includes the space of removed elements that is not reused yet.
  std::size_t capacity() const { return values_.capacity(); }

  void push_back(T value) {
    make_room(1);
    values_.push_back(std::move(value));
  }
  void append(std::span<const T> more) {
    make_room(more.size());
    values_.insert(values_.end(), more.begin(), more.end());
  }
  void insert(const_iterator before, T value) { values_.insert(before, std::move(value)); }
  void resize(std::size_t count) { values_.resize(first_ + count); }
  /// Removes the first `count` elements. `count` must be at most size().
  void pop_front(std::size_t count = 1) {
    first_ += count;
    if (first_ == values_.size()) clear();
  }
  void clear() {
    values_.clear();
    first_ = 0;
  }
  void remove_if(auto is_it) {
    values_.erase(values_.begin(), begin());
    first_ = 0;
    std::erase_if(values_, is_it);
  }

 private:
  /// Reuses the space of removed elements only when they are at least half of all elements, so each element
  /// is moved only a few times.
  void make_room(std::size_t count) {
    if (values_.size() + count <= values_.capacity() || 2 * first_ < values_.size()) return;
    values_.erase(values_.begin(), begin());
    first_ = 0;
  }

  std::vector<T> values_;
  std::size_t first_ = 0;
};

}  // namespace understudy

#pragma once
#include <cstddef>
#include <vector>

namespace wormdrive {

/// First in, first out; allocates only to hold more than it has held before.
template <class T>
class Queue {
 public:
  bool empty() const { return front_ == items_.size(); }
  std::size_t size() const { return items_.size() - front_; }
  const T& front() const { return items_[front_]; }
  auto begin() const { return items_.begin() + static_cast<std::ptrdiff_t>(front_); }
  auto end() const { return items_.end(); }

  void push(const T& item) {
    // Moving up at least as many as remain keeps the cost of a push bounded; otherwise the place is doubled.
    if (items_.size() == items_.capacity() && front_ > items_.size() / 2) {
      items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(front_));
      front_ = 0;
    }
    items_.push_back(item);
  }
  void pop() {
    if (++front_ == items_.size()) clear();
  }
  void clear() {
    items_.clear();
    front_ = 0;
  }

 private:
  std::vector<T> items_{};
  std::size_t front_ = 0;  ///< index of the first that is still in
};

}  // namespace wormdrive

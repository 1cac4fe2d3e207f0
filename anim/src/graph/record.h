#pragma once

// A list that grows at its end and is copied often: copies share all but the last few entries.

#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace tweenfall::graphs {

template <class T>
class Record {
 public:
  class Iterator {
   public:
    using difference_type = std::ptrdiff_t;
    using value_type = T;
    using pointer = const T*;
    using reference = const T&;
    using iterator_category = std::random_access_iterator_tag;

    Iterator() = default;
    Iterator(const Record* record, std::size_t index) : record_(record), index_(index) {}

    reference operator*() const noexcept { return (*record_)[index_]; }
    pointer operator->() const noexcept { return &(*record_)[index_]; }
    reference operator[](difference_type n) const noexcept { return *(*this + n); }
    Iterator& operator+=(difference_type n) noexcept {
      index_ = static_cast<std::size_t>(static_cast<difference_type>(index_) + n);
      return *this;
    }
    Iterator& operator-=(difference_type n) noexcept { return *this += -n; }
    Iterator& operator++() noexcept { return *this += 1; }
    Iterator& operator--() noexcept { return *this += -1; }
    Iterator operator++(int) noexcept {
      Iterator before = *this;
      ++*this;
      return before;
    }
    Iterator operator--(int) noexcept {
      Iterator before = *this;
      --*this;
      return before;
    }
    friend Iterator operator+(Iterator a, difference_type n) noexcept { return a += n; }
    friend Iterator operator+(difference_type n, Iterator a) noexcept { return a += n; }
    friend Iterator operator-(Iterator a, difference_type n) noexcept { return a -= n; }
    friend difference_type operator-(const Iterator& a, const Iterator& b) noexcept {
      return static_cast<difference_type>(a.index_) - static_cast<difference_type>(b.index_);
    }
    friend bool operator==(const Iterator& a, const Iterator& b) noexcept { return a.index_ == b.index_; }
    friend auto operator<=>(const Iterator& a, const Iterator& b) noexcept { return a.index_ <=> b.index_; }

   private:
    const Record* record_ = nullptr;
    std::size_t index_ = 0;
  };

  [[nodiscard]] std::size_t size() const noexcept { return full_.size() * page_size + last_.size(); }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  [[nodiscard]] const T& operator[](std::size_t i) const noexcept {
    return i / page_size < full_.size() ? (*full_[i / page_size])[i % page_size] : last_[i % page_size];
  }
  [[nodiscard]] const T& front() const noexcept { return (*this)[0]; }
  [[nodiscard]] const T& back() const noexcept { return (*this)[size() - 1]; }
  [[nodiscard]] Iterator begin() const noexcept { return {this, 0}; }
  [[nodiscard]] Iterator end() const noexcept { return {this, size()}; }

  void push_back(T entry) {
    last_.push_back(std::move(entry));
    if (last_.size() < page_size) return;
    full_.push_back(std::make_shared<const std::vector<T>>(std::move(last_)));
    last_.clear();
  }
  /// The number of full pages of `page_size` entries, which copies share.
  [[nodiscard]] std::size_t full_pages() const noexcept { return full_.size(); }
  [[nodiscard]] const std::vector<T>& page(std::size_t i) const noexcept { return *full_[i]; }
  /// Replaces a page; copies keep theirs.
  void replace_page(std::size_t i, std::vector<T> page) {
    full_[i] = std::make_shared<const std::vector<T>>(std::move(page));
  }

  /// Removes the entries from `count` on.
  void truncate(std::size_t count) {
    if (count / page_size < full_.size()) {
      const std::vector<T>& page = *full_[count / page_size];
      last_.assign(page.begin(), page.begin() + static_cast<std::ptrdiff_t>(count % page_size));
      full_.resize(count / page_size);
    } else {
      last_.resize(count % page_size);
    }
  }
  /// Removes and returns the entries from an index on.
  [[nodiscard]] std::vector<T> take_from(std::size_t index) {
    std::vector<T> taken(begin() + static_cast<std::ptrdiff_t>(index), end());
    truncate(index);
    return taken;
  }

 private:
  static constexpr std::size_t page_size = 64;
  std::vector<std::shared_ptr<const std::vector<T>>> full_;
  std::vector<T> last_;
};

}  // namespace tweenfall::graphs

// Either throws the first fault of a file or collects them all, so that one reader serves loading and `validate`.
#pragma once
#include <utility>
#include <vector>

#include "engine/error.h"

namespace seascape {

class Faults {
 public:
  // Collects where `collect` is true; else the first fault is thrown on.
  explicit Faults(bool collect = false) : collect_(collect) {}

  // Runs one step of reading; a fault ends this step alone where faults are collected.
  template <class Step>
  void attempt(Step&& step) {
    try {
      std::forward<Step>(step)();
    } catch (const Error& fault) {
      if (!collect_) throw;
      list_.push_back(fault);
    }
  }

  const std::vector<Error>& list() const { return list_; }

 private:
  bool collect_;
  std::vector<Error> list_;
};

}  // namespace seascape

// What the rows of the sea's foam share: lists that are made once a thread.
#pragma once
#include <cstddef>

namespace seascape {

// Empties a list that is to hold as many at most, so that no later row makes it grow.
template <class T>
void with_room(std::vector<T>& list, std::size_t most) {
  list.clear();
  list.reserve(most);
}
}  // namespace seascape

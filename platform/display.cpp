#include "platform/display.h"

namespace seascape {

const Input& Display::input() const {
  static const Input nothing;
  return nothing;
}

}  // namespace seascape

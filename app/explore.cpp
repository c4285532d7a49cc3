#include "app/commands.h"
namespace seascape { int run_explore(const Arguments&) { return 0; } }

#include "app/commands.h"
namespace seascape { int run_plan(const Arguments&) { return 0; } }

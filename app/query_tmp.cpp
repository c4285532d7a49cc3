#include "app/commands.h"
namespace seascape { int run_query(const Arguments&) { return 0; } }

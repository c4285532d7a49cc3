// The commands of the program. Each returns the exit code, 0 or 1, and throws Error for a fault.
#pragma once
#include "app/arguments.h"

namespace seascape {

int run_explore(const Arguments& arguments);
int run_replay(const Arguments& arguments);
int run_capture(const Arguments& arguments);
int run_lab(const Arguments& arguments);
int run_bake(const Arguments& arguments);  // pure
int run_plan(const Arguments& arguments);
int run_query(const Arguments& arguments);     // pure: needs no GPU
int run_validate(const Arguments& arguments);  // pure
int run_doctor(const Arguments& arguments);

}  // namespace seascape

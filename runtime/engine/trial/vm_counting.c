/* SPDX-License-Identifier: MIT
 *
 * vm_counting - vm_run() with a call at each jump back, made of the same text.
 */
#include "engine/scan/vm.h"

#define VM_COUNTS_BACK
#define vm_run vm_run_counting
#include "engine/scan/vm.c"

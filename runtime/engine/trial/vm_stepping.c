/* SPDX-License-Identifier: MIT
 *
 * vm_stepping - vm_counting that can stand before a statement, made of the same text.
 */
#include "engine/scan/vm.h"

#define VM_COUNTS_BACK
#define VM_STEPS
#define vm_run vm_run_stepping
#include "engine/scan/vm.c"

/* SPDX-License-Identifier: MIT
 *
 * cases - makes the cases of the guest suite and of `replay` on the machine that builds:
 * every target must give the same results.
 */
#include "tests/targets/guest/cases/cases.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv)
{
	if (argc >= 5 && argc <= 6 && strcmp(argv[1], "plan") == 0)
		return make_plan(argv[2], argv[3], argv[4],
				 argc == 6 ? argv[5] : NULL);
	if (argc == 4 && strcmp(argv[1], "bad") == 0)
		return make_bad(argv[2], argv[3]);
	if (argc == 5 && strcmp(argv[1], "bundle") == 0)
		return make_bundle(argv[2],
				   (uint32_t)strtoul(argv[3], NULL, 10),
				   strtoull(argv[4], NULL, 10));
	fprintf(stderr, "usage: make_cases plan FOLDER RUNG SCN [MAP] | "
		"bad FOLDER IMAGE | bundle FILE COUNT SEED\n");
	return 2;
}

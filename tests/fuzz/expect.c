/* SPDX-License-Identifier: MIT
 *
 * expect - reports a broken promise and ends the fuzz target.
 */
#include "tests/fuzz/fuzz.h"

#include <stdio.h>
#include <stdlib.h>

void fuzz_expect(int promise, const char *text)
{
	if (promise)
		return;
	fprintf(stderr, "# broken: %s\n", text);
	abort();
}

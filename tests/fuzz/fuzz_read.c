/* SPDX-License-Identifier: MIT
 *
 * fuzz_read - reads any bytes as a rung file, checks, translates and writes it. The written
 * text must be readable, and writing it again must give the same bytes.
 */
#include "engine/ladder.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	(void)bytes;
	*out_len = len;
	return NULL;
}

static void write_twice(struct ladder *ladder)
{
	size_t len, again_len;
	char *text = ladder_write(ladder, &len);
	struct ladder *other = ladder_new();
	char *again;

	fuzz_expect(text && other, "a project that was read can be written");
	fuzz_expect(ladder_load_text(other, "again.rung", text, len),
		    "what was written can be read");
	again = ladder_write(other, &again_len);
	fuzz_expect(again && again_len == len && memcmp(text, again, len) == 0,
		    "the canonical form does not change");
	free(again);
	free(text);
	ladder_free(other);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct ladder *ladder = ladder_new();
	struct diag_list *diags = ladder_diags(ladder);

	if (!ladder_load_text(ladder, "fuzz.rung", bytes, len)) {
		fuzz_expect(diags->errors > 0, "a refused file has an error");
		fuzz_expect(!ladder_program(ladder), "nothing is half loaded");
	} else if (ladder_project(ladder)) {
		write_twice(ladder);
		fuzz_expect(ladder_build(ladder) == (diags->errors == 0),
			    "a build fails just when there is an error");
	}
	ladder_free(ladder);
	return 0;
}

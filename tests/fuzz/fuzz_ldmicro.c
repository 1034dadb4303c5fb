/* SPDX-License-Identifier: MIT
 *
 * fuzz_ldmicro - reads any bytes as a program of LDmicro and imports it.
 *
 * What is read becomes a text of rungs that can be read again, or there is an error; each element is
 * in the report's count or in a line of it.
 */
#include "engine/exchange/ldmicro/ldmicro.h"
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

/* The number of elements in the line that counts them. */
static long told(const struct classic_report *report)
{
	for (int i = 0; i < report->count; i++) {
		const char *with = strstr(report->line[i].text, ", elements: ");

		if (report->line[i].kind == REPORT_TAKEN && with)
			return strtol(with + strlen(", elements: "), NULL, 10);
	}
	return -1;
}

static void look_at(const uint8_t *bytes, size_t len)
{
	struct import import = { .path = "fuzz.ld", .bytes = bytes, .len = len, .task = true };
	struct ldmicro_program *program;
	struct classic_report report;
	struct diag_list diags;
	struct arena arena;

	arena_init(&arena);
	report_init(&report);
	diag_init(&diags);
	import.arena = &arena;
	import.report = &report;
	import.diags = &diags;
	program = ldmicro_read(&import);
	fuzz_expect(!program == (diags.errors > 0), "a program, or an error");
	if (program && ldmicro_to_rung(&import, program)) {
		fuzz_expect(import.text.len > 0 && import.period_ns > 0, "a text and a period");
		fuzz_expect(told(&report) == program->elements,
			    "each element is told");
	}
	arena_free(&arena);
	report_free(&report);
}

static void import(const uint8_t *bytes, size_t len)
{
	struct ladder *ladder = ladder_new();

	if (!ladder || !ladder_take_others(ladder))
		abort();
	ladder_classic_task(ladder, len & 1);
	if (!ladder_load_text(ladder, "fuzz.ld", bytes, len) || !ladder_build(ladder))
		fuzz_expect(ladder_diags(ladder)->errors > 0, "no program, no error");
	ladder_free(ladder);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	look_at(bytes, len);
	if (ldmicro_is(bytes, len))
		import(bytes, len);
	return 0;
}

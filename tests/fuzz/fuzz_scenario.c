/* SPDX-License-Identifier: MIT
 *
 * fuzz_scenario - reads any bytes as a scenario file, and runs short scenarios.
 */
#include "engine/trial/scenario.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/sandbox.h"

#define SCANS_MAX 2000

static bool is_short(const struct scenario *scenario)
{
	int64_t end_ns = 0;

	for (int i = 0; i < scenario->step_count; i++) {
		const struct scenario_step *step = &scenario->step[i];

		if (step->at_ns > INT64_MAX - step->span_ns)
			return false;
		if (step->at_ns + step->span_ns > end_ns)
			end_ns = step->at_ns + step->span_ns;
	}
	return scenario->period_ns > 0 &&
	       end_ns / scenario->period_ns < SCANS_MAX;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct sandbox *sandbox;
	struct diag_list diags;
	struct scenario_file file = { 0 };
	struct arena arena;

	if (len > 4096)
		return 0;
	sandbox = sandbox_open();
	diag_init(&diags);
	arena_init(&arena);
	if (!scenario_read("fuzz.scn", (const char *)bytes, len,
			   &sandbox->resource.image, NULL, (struct formula_projects){ NULL, NULL },
			   &arena, &file,
			   &diags)) {
		fuzz_expect(diags.errors > 0, "a refused file has an error");
		file.count = 0;
	}
	for (int i = 0; i < file.count && i < 8; i++)
		if (is_short(&file.scenario[i]))
			scenario_run(&file, i, &sandbox->resource, NULL,
				     &sandbox->sink);
	arena_free(&arena);
	return 0;
}

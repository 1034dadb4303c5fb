/* SPDX-License-Identifier: MIT
 *
 * fuzz_script - reads any bytes as a stimulus script, and runs it if it has few scans.
 */
#include "engine/trial/script.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/sandbox.h"

/* `x` and more than three digits: a script may ask for a thousand million scans. */
static bool is_long(const uint8_t *bytes, size_t len)
{
	for (size_t i = 0; i + 1 < len; i++) {
		size_t digits = 0;

		if ((bytes[i] | 0x20) != 'x')
			continue;
		while (i + 1 + digits < len && bytes[i + 1 + digits] >= '0' &&
		       bytes[i + 1 + digits] <= '9')
			digits++;
		if (digits > 3)
			return true;
	}
	return false;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct sandbox *sandbox;
	struct diag_list diags;
	struct trace trace;

	if (is_long(bytes, len) || len > 4096)
		return 0;
	sandbox = sandbox_open();
	diag_init(&diags);
	trace_init(&trace, &sandbox->resource.image, &sandbox->sink,
		   (enum trace_form)(len % 3), len & 1);
	if (!script_run("fuzz.script", (const char *)bytes, len, 10000000,
			&sandbox->resource, NULL, &trace, &diags))
		fuzz_expect(diags.errors > 0, "a refused script has an error");
	trace_end(&trace);
	trace_free(&trace);
	return 0;
}

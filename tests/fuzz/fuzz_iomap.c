/* SPDX-License-Identifier: MIT
 *
 * fuzz_iomap - reads any bytes as an I/O map.
 */
#include "hal/iomap.h"
#include "tests/fuzz/fuzz.h"

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	(void)bytes;
	*out_len = len;
	return NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct diag_list diags;
	struct iomap map = { 0 };
	struct arena arena;
	char text[128];

	diag_init(&diags);
	arena_init(&arena);
	if (!iomap_read(&map, &arena, "fuzz.io", (const char *)bytes, len,
			&diags)) {
		fuzz_expect(diags.errors > 0, "a refused map has an error");
	}
	for (int i = 0; i < map.count; i++) {
		struct diag place = io_place(&map, &map.point[i], DIAG_IO_BUSY);

		io_line_print(&map.point[i], text, sizeof(text));
		fuzz_expect(place.line > 0, "a point has a line");
	}
	arena_free(&arena);
	return 0;
}

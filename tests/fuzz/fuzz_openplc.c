/* SPDX-License-Identifier: MIT
 *
 * fuzz_openplc - reads any bytes as the project.json of OpenPLC Editor, with POUs in it.
 */
#include "engine/exchange/openplc/json.h"
#include "engine/ladder.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	(void)bytes;
	*out_len = len;
	return NULL;
}

static void look_at(const uint8_t *bytes, size_t len)
{
	const char *text = (const char *)bytes, *end = text;
	struct arena arena;
	int line = 1;

	arena_init(&arena);
	const struct json *json = json_read(&arena, text, len, &line, &end);

	fuzz_expect(line > 0 && end >= text && end <= text + len, "a place in the text");
	for (const struct json *each = json_items(json); each; each = each->next)
		fuzz_expect(each->line > 0 && each->text && (json->kind != JSON_OBJECT || each->key),
			    "a value has a line and a text");
	arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct ladder *ladder = ladder_new();

	look_at(bytes, len);
	if (!ladder || !ladder_take_others(ladder))
		abort();
	if (!ladder_load_text(ladder, "/nowhere/project.json", bytes, len) || !ladder_build(ladder))
		fuzz_expect(ladder_diags(ladder)->errors > 0, "no program, no error");
	ladder_free(ladder);
	return 0;
}

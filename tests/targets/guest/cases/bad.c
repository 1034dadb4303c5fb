/* SPDX-License-Identifier: MIT
 *
 * bad - makes images with one error each. Their checksums are correct, so the other checks
 * must refuse them.
 */
#include "tests/targets/guest/cases/cases.h"

#include "engine/base/digest.h"
#include "engine/base/limits.h"
#include "engine/scan/code.h"

#include <stdio.h>
#include <string.h>

#define IMAGE_MOST 65536

static void seal(uint8_t *bytes)
{
	struct code_header *header = (struct code_header *)bytes;
	size_t covered = offsetof(struct code_header, crc) + 4;

	header->crc = digest_crc32c(0, bytes + covered,
				    header->size - covered);
}

static bool save(const char *folder, const char *name, const void *bytes,
		 size_t len)
{
	char path[512];
	FILE *out;
	bool good;

	snprintf(path, sizeof(path), "%s/%s", folder, name);
	out = fopen(path, "wb");
	good = out && fwrite(bytes, 1, len, out) == len;
	if (out && fclose(out) != 0)
		good = false;
	if (!good)
		perror(path);
	return good;
}

/* After the magic all data is words of four bytes, except names. */
static void turn_words(uint8_t *bytes, size_t len)
{
	for (size_t i = sizeof(((struct code_header *)0)->magic); i + 4 <= len;
	     i += 4) {
		uint8_t word[4];

		memcpy(word, bytes + i, 4);
		for (int k = 0; k < 4; k++)
			bytes[i + (size_t)k] = word[3 - k];
	}
}

int make_bad(const char *folder, const char *image)
{
	static _Alignas(8) uint8_t good[IMAGE_MOST], bad[IMAGE_MOST];
	struct code_header *header = (struct code_header *)bad;
	FILE *in = fopen(image, "rb");
	size_t len = in ? fread(good, 1, sizeof(good), in) : 0;
	bool saved = len > sizeof(*header) && len < sizeof(good);

	if (in)
		fclose(in);
	memcpy(bad, good, sizeof(bad));
	header->version++;
	seal(bad);
	saved = saved && save(folder, "bad-version.rungc", bad, len);
	memcpy(bad, good, sizeof(bad));
	turn_words(bad, len);
	saved = saved && save(folder, "bad-order.rungc", bad, len);
	memcpy(bad, good, sizeof(bad));
	memset(bad + header->section[CODE_TEXT].offset, 0xff, 4);
	seal(bad);
	saved = saved && save(folder, "bad-rules.rungc", bad, len);
	memcpy(bad, good, sizeof(bad));
	header->area_bytes[AREA_Q] = 0;
	seal(bad);
	saved = saved && save(folder, "bad-areas.rungc", bad, len);
	memcpy(bad, good, sizeof(bad));
	header->data_size = LIMIT_DATA;
	seal(bad);
	saved = saved && save(folder, "bad-memory.rungc", bad, len);
	if (!saved)
		fprintf(stderr, "make_cases: %s: no good image\n", image);
	return !saved;
}

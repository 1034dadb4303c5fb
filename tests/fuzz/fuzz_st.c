/* SPDX-License-Identifier: MIT
 *
 * fuzz_st - reads any bytes as plain IEC text, or as the statements of a program, checks, translates and
 * runs them. What was read is written, and reads again the same.
 *
 * Bytes that are no ASCII stand for words of the language, so that much of what they make is close to a
 * program. An input that begins with MADE is a random program (tests/st/st_random.h) with a few changes.
 */
#include "engine/ladder.h"
#include "tests/fuzz/fuzz.h"
#include "tests/st/st_random.h"

#include <stdlib.h>
#include <string.h>

#define SCANS 3
#define DATA_MAX (2u << 20)

static const char head[] =
	"PROGRAM Main\nVAR\n  A, B, C, i : INT; D : DINT; U : USINT; R : REAL; L : LREAL; W : WORD; On : BOOL; Off1 : BOOL;\n"
	"  P : TIME; N : STRING[8]; T : ARRAY[1..3] OF INT; T2 : ARRAY[0..1, 1..2] OF REAL; Wait : TON; Up : CTU; E : R_TRIG;\n"
	"  K : (Red, Green := 5, Blue); S : INT (0..9);\nEND_VAR\n";

/* Bytes from here on are words. */
#define PLAIN 0x80
static const char *const words[] = {
	"IF ", "THEN\n", "ELSIF ", "ELSE\n", "END_IF;\n", "CASE ", "OF\n", "END_CASE;\n", "FOR i := ", "TO ", "BY ", "DO\n",
	"END_FOR;\n", "WHILE ", "END_WHILE;\n", "REPEAT\n", "UNTIL ", "END_REPEAT;\n", "EXIT;\n", "CONTINUE;\n", "RETURN;\n",
	"A", "B", "D", "U", "R", "L", "W", "On", "T[", "T2[", "]", "(", ")", ", ", " := ", " + ", " - ", " * ", " / ", " MOD ",
	" AND ", " OR ", " XOR ", "NOT ", " = ", " <> ", " < ", " >= ", ";\n", "1", "0", "32767", "-5", "1.5", "T#5ms", "'abc'",
	"16#FF", "TRUE", "Red", "K", "S", "N", "P", "Wait(", "Up(", "E(", "IN := ", "PT := ", "Q => ", "Wait.Q", "..", ": ",
	"MAX(", "LIMIT(", "SEL(", "INT_TO_REAL(", "(* c *)", "// c\n", "END_PROGRAM\n", "VAR\n", "END_VAR\n", "{p}", "K#Red",
};
#define WORDS (sizeof(words) / sizeof(*words))

#define MADE 0x01
#define MADE_MAX (64 * 1024)
#define CHANGES 3

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	(void)bytes;
	*out_len = len;
	return NULL;
}

static bool is_whole(const char *text)
{
	return strstr(text, "PROGRAM") || strstr(text, "FUNCTION") || strstr(text, "TYPE");
}

static char *put(char *at, const char *text)
{
	const size_t len = strlen(text);

	memcpy(at, text, len);
	return at + len;
}

/* The text of an input; its bytes above PLAIN are words. malloc'ed. */
static char *spell(const uint8_t *bytes, size_t len, size_t *out_len)
{
	const size_t room = sizeof(head) + len * 16 + 16;
	char *text = malloc(room), *at = text;
	char *copy = malloc(len + 1);
	bool wrap;

	if (!text || !copy) {
		free(text);
		free(copy);
		return NULL;
	}
	memcpy(copy, bytes, len);
	copy[len] = '\0';
	wrap = !is_whole(copy);
	free(copy);
	if (wrap)
		at = put(at, head);
	for (size_t i = 0; i < len; i++)
		if (wrap && bytes[i] >= PLAIN)
			at = put(at, words[(bytes[i] - PLAIN) % WORDS]);
		else
			*at++ = (char)bytes[i];
	if (wrap)
		at = put(at, "\nEND_PROGRAM\n");
	*out_len = (size_t)(at - text);
	return text;
}

/* The program of the number in bytes 1 and 2; each 4 bytes more put a word, or nothing, in place of what stands
 * between two places. malloc'ed. */
static char *make(const uint8_t *bytes, size_t len, size_t *out_len)
{
	char *text = malloc(MADE_MAX + CHANGES * 32);
	size_t size;

	if (!text)
		return NULL;
	size = st_random_print((uint64_t)bytes[1] << 8 | bytes[2], text, MADE_MAX);
	for (size_t i = 3; i + 4 <= len && i < 3 + 4 * CHANGES; i += 4) {
		const size_t at = ((size_t)bytes[i] << 8 | bytes[i + 1]) % size;
		size_t end = at + bytes[i + 2] % 12;
		const char *word = bytes[i + 3] >= PLAIN ? words[(bytes[i + 3] - PLAIN) % WORDS] : "";
		const size_t word_len = strlen(word);

		if (end > size)
			end = size;
		memmove(text + at + word_len, text + end, size - end);
		memcpy(text + at, word, word_len);
		size = at + word_len + size - end;
	}
	*out_len = size;
	return text;
}

static void write_twice(struct ladder *ladder)
{
	size_t len, again_len;
	char *text = ladder_write(ladder, &len);
	struct ladder *other = ladder_new();
	char *again;

	fuzz_expect(text && other, "a project that was read can be written");
	fuzz_expect(ladder_load_text(other, "again.st", text, len), "what was written can be read");
	again = ladder_write(other, &again_len);
	fuzz_expect(again && again_len == len && memcmp(text, again, len) == 0,
		    "the canonical form does not change");
	free(again);
	free(text);
	ladder_free(other);
}

static void run(struct ladder *ladder)
{
	const struct program *program = ladder_program(ladder);
	const size_t size = (image_memory_size(program) + 7) / 8 * 8;
	static struct resource resource;
	void *memory;

	if (size > DATA_MAX)
		return;
	memory = aligned_alloc(8, size);
	fuzz_expect(memory != NULL, "memory");
	resource_init(&resource, program, memory);
	resource_start(&resource);
	for (int i = 0; i < SCANS; i++)
		if (!resource_scan(&resource, 1000000 * (int64_t)i))
			break; /* a loop that does not end */
	free(memory);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct ladder *ladder = ladder_new();
	struct diag_list *diags = ladder_diags(ladder);
	size_t size = 0;
	char *text = len > 2 && *bytes == MADE ? make(bytes, len, &size) : spell(bytes, len, &size);

	fuzz_expect(ladder && text, "memory");
	ladder_watch(ladder, len % 2);
	if (!ladder_load_text(ladder, "fuzz.st", text, size)) {
		fuzz_expect(diags->errors > 0, "a refused file has an error");
		fuzz_expect(!ladder_program(ladder), "nothing is half loaded");
	} else if (ladder_project(ladder)) {
		const bool good = ladder_build(ladder);

		fuzz_expect(good == (diags->errors == 0), "a build fails just when there is an error");
		write_twice(ladder);
		if (good)
			run(ladder);
	}
	free(text);
	ladder_free(ladder);
	return 0;
}

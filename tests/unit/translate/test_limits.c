/* SPDX-License-Identifier: MIT
 *
 * test_limits - programs that are too large are refused with a message, not with
 * an image that cannot be loaded. They are too large for a golden case.
 */
#include "engine/ladder.h"
#include "tests/tap.h"

#include <stdlib.h>

struct buffer {
	char *text;
	size_t len, size;
};

static void add(struct buffer *b, const char *form, int number)
	__attribute__((format(printf, 2, 0)));
static void add(struct buffer *b, const char *form, int number)
{
	if (b->size - b->len < 200) {
		b->size = b->size * 2 + 4096;
		b->text = realloc(b->text, b->size);
		if (!b->text)
			abort();
	}
	b->len += (size_t)snprintf(b->text + b->len, 200, form, number);
}

/* @tons declarations of instances, each of @form, and a chain of @sums operations on variables of @type. */
static void make(struct buffer *b, int tons, const char *form[2], int sums, const char *type)
{
	b->len = 0;
	add(b, "RUNGBOARD 1\nVAR\n  N : ", 0);
	add(b, type, 0);
	add(b, ";\n", 0);
	for (int i = 0; i < tons; i++)
		add(b, form[0], i);
	add(b, "END_VAR\nPROGRAM Main IL\n", 0);
	/* Open pins would give warnings, and the list is full at 100. */
	for (int i = 0; i < tons; i++)
		add(b, form[1], i);
	add(b, "  LD N\n", 0);
	for (int i = 0; i < sums; i++)
		add(b, "ADD N\n", 0);
	add(b, "  ST N\nEND_PROGRAM\n", 0);
}

/* The error that building ends with; DIAG_COUNT: none. */
static enum diag_id builds(const struct buffer *b)
{
	struct ladder *ladder = ladder_new();
	enum diag_id error = DIAG_COUNT;
	size_t len;

	if (ladder_load_text(ladder, "large.rung", b->text, b->len))
		ladder_build(ladder);
	const struct diag_list *diags = ladder_diags(ladder);

	for (int i = 0; i < diags->count; i++)
		if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR)
			error = diags->diag[i].id;
	CHECK(diags->errors == (error == DIAG_COUNT ? 0 : 1));
	CHECK((error == DIAG_COUNT) == (ladder_program(ladder) != NULL));
	CHECK(error == DIAG_COUNT || !ladder_image(ladder, &len));
	ladder_free(ladder);
	return error;
}

int main(void)
{
	static const char *one[] = { "  D%d : TON;\n", "CAL D%d(IN := 1, PT := T#1s)\n" };
	static const char *hundred[] = { "  D%d : ARRAY[0..99] OF TON;\n", "CAL D%d[99](IN := 1, PT := T#1s)\n" };
	struct buffer b = { NULL, 0, 0 };

	make(&b, 100000, one, 1000, "TIME");
	CHECK(builds(&b) == DIAG_COUNT);
	make(&b, 2200, hundred, 60000, "TIME");
	CHECK(builds(&b) == DIAG_DATA_TOO_LARGE);
	make(&b, 0, one, 1600000, "SINT");
	CHECK(builds(&b) == DIAG_CODE_TOO_LARGE);
	free(b.text);
	return tap_done();
}

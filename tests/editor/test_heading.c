/* SPDX-License-Identifier: MIT
 *
 * test_heading - what stands above a rung is not cut, however much room there is: with the
 * fonts of this machine, because it is they that make a line just fit or not.
 */
#include "editor-gtk/rung_text.h"
#include "tests/editor/drawn.h"
#include "tests/tap.h"

#include <glib.h>

#define ELLIPSIS "\xe2\x80\xa6"
#define LATIN "The first pump runs while the level is low, and the second one helps if it " \
	      "has been low for a minute; both stop when the upper float is reached."
#define CHINESE "\xe6\xb0\xb4\xe4\xbd\x8d\xe4\xbd\x8e\xe6\x97\xb6\xe7\xac\xac\xe4\xb8\x80" \
		"\xe6\xb3\xb5\xe8\xbf\x90\xe8\xa1\x8c\xef\xbc\x8c\xe4\xb8\x80\xe5\x88\x86" \
		"\xe9\x92\x9f\xe5\x90\x8e\xe7\xac\xac\xe4\xba\x8c\xe6\xb3\xb5 P2 \xe5\xb8" \
		"\xae\xe5\xbf\x99\xef\xbc\x9b\xe4\xb8\x8a\xe6\xb5\xae\xe7\x90\x83\xe5\x88" \
		"\xb0\xe8\xbe\xbe\xe6\x97\xb6\xe4\xb8\xa4\xe6\xb3\xb5\xe5\x81\x9c\xe6\xad" \
		"\xa2\xe3\x80\x82"

static struct lettering *lettering;

static char *without_blanks(const char *text)
{
	GString *out = g_string_new(text);

	g_string_replace(out, " ", "", 0);
	return g_string_free(out, FALSE);
}

struct read { GString *all; float widest; };

static void take(void *context, int line, struct lettered text)
{
	struct read *read = context;

	(void)line;
	g_string_append(read->all, text.text);
	read->widest = MAX(read->widest, text.width);
}

/* All of it is read, and in no more room than there is. */
static bool is_whole(const char *text, float width)
{
	const struct drafting drafting = { .lettering = lettering };
	struct read read = { g_string_new(NULL), 0 };
	char *want = without_blanks(text), *got;
	bool whole;

	rung_comment_lines(&drafting, text, width, 1000, take, &read);
	got = without_blanks(read.all->str);
	whole = strcmp(got, want) == 0 && read.widest <= width + 0.1f;
	if (!whole)
		printf("# %g px: %s\n", (double)width, read.all->str);
	g_string_free(read.all, TRUE);
	g_free(want);
	g_free(got);
	return whole;
}

static void check_comment(const char *text, const char *what)
{
	int cut = 0;

	for (float width = 300; width < 620; width += 0.7f)
		cut += !is_whole(text, width);
	CHECK_AS(cut == 0, what);
}

int main(void)
{
	PangoContext *context = lettering_context();

	lettering = lettering_new(context, NULL);
	check_comment(LATIN, "no line of a comment loses its end");
	check_comment(CHINESE, "nor in Chinese");
	lettering_free(lettering);
	lettering = lettering_new(NULL, NULL);
	check_comment(LATIN, "nor without fonts");
	lettering_free(lettering);
	g_object_unref(context);
	return tap_done();
}

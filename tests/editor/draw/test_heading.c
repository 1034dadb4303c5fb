/* SPDX-License-Identifier: MIT
 *
 * test_heading - texts above a rung are not cut while there is room. Uses the fonts of this
 * machine, which decide whether a line just fits.
 */
#include "editor-gtk/draw/rung_text.h"
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

/* Is all of the text drawn, inside its width? */
static bool is_whole(const char *text, float width)
{
	const struct drafting drafting = { .lettering = lettering };
	struct read read = { g_string_new(NULL), 0 };
	char *want = without_blanks(text), *got;
	bool whole;

	rung_lines(&drafting, LETTER_COMMENT, text, width, 1000, take, &read);
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

/* ---- title, label and comment on a sheet ---- */

/* The texts of a rung in one style, without blanks. */
static char *said_in(const struct picture *picture, enum letter letter)
{
	GString *all = g_string_new(NULL);

	for (int i = 0; i < picture->count; i++)
		if (picture->stroke[i].kind == STROKE_TEXT &&
		    picture->stroke[i].letter == letter)
			g_string_append(all, picture->stroke[i].text);
	g_string_replace(all, " ", "", 0);
	return g_string_free(all, FALSE);
}

/* For the only rung of @sheet: no overlaps, nothing behind the right rail. */
static int heading_faults(const struct sheet *sheet, const char *title, const char *comment)
{
	const struct rung_layout *layout = sheet->rung[0];
	const struct grid_scene scene = { .drafting = &sheet->drafting, .layout = layout,
					  .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
	char *plain = without_blanks(title), *rest = without_blanks(comment);
	struct picture picture;

	picture_init(&picture);
	grid_draw(&scene, &picture);
	int faults = drawn_faults(&picture, layout->right + 0.6f, layout->height, title);
	char *said = said_in(&picture, LETTER_TITLE), *told = said_in(&picture,
								      LETTER_COMMENT);
	if (sheet->drafting.all_comments)
		faults += strcmp(said, plain) != 0;
	faults += strcmp(told, rest) != 0;
	if (faults)
		printf("# %s: %s | %s\n", title, said, told);
	picture_clear(&picture);
	g_free(said);
	g_free(told);
	g_free(plain);
	g_free(rest);
	return faults;
}

/* @len: bytes of @text that are the title. @paper: all of it is drawn */
static int title_faults(const char *label, const char *text, size_t len, const char *comment,
			bool paper)
{
	char *title = g_strndup(text, len);
	char *all = g_strdup_printf("RUNGBOARD 1\n\nPROGRAM Main LD\n%s%s%s\nRUNG %s \"%s\"\n"
				    "  | NO %%IX0.0 | COIL %%QX0.0 |\nEND_PROGRAM\n",
				    *comment ? "(* " : "", comment, *comment ? " *)" : "",
				    label, title);
	struct ladder *ladder = drawn_load("title.rung", all);
	int faults = 1;

	if (ladder) {
		const struct project *project = ladder_project(ladder);
		struct sheet *sheet = sheet_new(project, &project->pou[0], lettering);

		sheet->drafting.all_comments = paper;
		sheet_layout(sheet);
		faults = heading_faults(sheet, title, comment);
		sheet_free(sheet);
		ladder_free(ladder);
	}
	g_free(title);
	g_free(all);
	return faults;
}

static void check_titles(void)
{
	static const char *const labels[] = { "", "Start",
		"The_label_of_a_rung_that_has_a_name_which_nobody_reads_to_its_end" };
	int paper = 0, screen = 0;

	for (int i = 0; i < 3; i++)
		for (const char *end = CHINESE LATIN; *end; end = g_utf8_next_char(end)) {
			const char *all = CHINESE LATIN;
			const char *comment = (end - all) % 3 ? "" : "What it is for.";

			paper += title_faults(labels[i], all, (size_t)(end - all), comment,
					      true);
			screen += title_faults(labels[i], all, (size_t)(end - all), comment,
					       false);
		}
	CHECK_AS(paper == 0, "on paper a title continues in another line");
	CHECK_AS(screen == 0, "on the screen a title ends before the right rail");
	/* A wide sheet does not keep the line breaks of a narrow rung. */
	CHECK(title_faults("", LATIN LATIN LATIN LATIN, strlen(LATIN) * 4, LATIN, true) == 0);
}

int main(void)
{
	PangoContext *context = lettering_context();

	lettering = lettering_new(context, NULL);
	check_comment(LATIN, "no line of a comment loses its end");
	check_comment(CHINESE, "no line of a Chinese comment loses its end");
	check_titles();
	lettering_free(lettering);
	lettering = lettering_new(NULL, NULL);
	check_comment(LATIN, "no line of a comment loses its end without fonts");
	lettering_free(lettering);
	g_object_unref(context);
	return tap_done();
}

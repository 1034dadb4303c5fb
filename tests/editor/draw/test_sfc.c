/* SPDX-License-Identifier: MIT
 *
 * test_sfc - charts: drawn without overlaps, every place can be hit, active steps differ
 * not only in colour, and rungs of bodies can be edited and undone.
 */
#include "editor-gtk/document/document.h"
#include "editor-gtk/draw/sfc_draw.h"
#include "tests/editor/drawn.h"
#include "tests/editor/lines.h"
#include "tests/tap.h"

#include <stdlib.h>

static struct lettering *lettering;

static struct ladder *load(const char *path)
{
	struct ladder *ladder = ladder_new();

	if (ladder_load(ladder, path) || ladder_could_read(ladder))
		return ladder;
	ladder_free(ladder);
	return NULL;
}

/* ---- drawing ---- */

static bool is_inside(const struct stroke *s, const struct sfc_sheet *sheet)
{
	return s->x >= 0 && s->y >= 0 && s->x <= sheet->width && s->y <= sheet->height;
}

/* Texts overlap no other text and no stroke. */
static int count_faults(const struct picture *picture, const struct sfc_sheet *sheet)
{
	int faults = 0;

	for (int i = 0; i < picture->count; i++) {
		const struct stroke *a = &picture->stroke[i];

		faults += !is_inside(a, sheet);
		if (a->kind != STROKE_TEXT)
			continue;
		for (int k = 0; k < picture->count; k++) {
			const struct stroke *b = &picture->stroke[k];
			const bool over = b->kind == STROKE_TEXT ?
				k > i && meet(ink_of(a), ink_of(b)) :
				b->kind == STROKE_LINE && crosses(ink_of(a), b);

			if (over && faults++ == 0)
				printf("# \"%s\" at %g, %g\n", a->text, (double)a->x,
				       (double)a->y);
		}
	}
	return faults;
}

static void draw(const struct sfc_sheet *sheet, const struct sfc_live *live,
		 struct picture *picture)
{
	const struct sfc_scene scene = { .sheet = sheet, .live = live,
					 .theme = theme_get(THEME_LIGHT, THEME_GREEN) };

	picture_init(picture);
	sfc_draw(&scene, picture);
}

static void check_hits(const struct sfc_sheet *sheet)
{
	int missed = 0;

	for (int i = 0; i < sheet->layout->shape_count; i++) {
		const graphene_rect_t box = sfc_sheet_box(sheet, i);
		const struct sfc_at at = sfc_sheet_at(sheet,
			box.origin.x + box.size.width / 2,
			box.origin.y + box.size.height / 2, 0);

		missed += at.shape != i || at.use != -1;
	}
	for (int i = 0; i < sheet->layout->sfc->use_count; i++) {
		const graphene_rect_t box = sfc_sheet_use(sheet, i);
		const struct sfc_at at = sfc_sheet_at(sheet,
			box.origin.x + box.size.width / 2,
			box.origin.y + box.size.height / 2, 0);

		missed += at.use != i || at.shape != sheet->layout->sfc->use[i].step;
	}
	CHECK_AS(missed == 0, "the middle of every box and line hits it");
	CHECK(sfc_sheet_at(sheet, -100, -100, 10).shape == -1);
}

static void check_chart(const char *path)
{
	struct ladder *ladder = load(path);
	const struct pou *pou;
	struct sfc_sheet *sheet;
	struct picture picture;

	if (!CHECK_AS(ladder != NULL, path))
		return;
	pou = &ladder_project(ladder)->pou[0];
	sheet = sfc_sheet_new(ladder_project(ladder), pou, lettering);
	draw(sheet, NULL, &picture);
	CHECK_AS(count_faults(&picture, sheet) == 0, "charts have no overlaps");
	check_hits(sheet);
	picture_clear(&picture);
	sfc_sheet_free(sheet);
	ladder_free(ladder);
}

static int count_strokes(const struct picture *picture, enum stroke_kind kind,
			 enum token token)
{
	int count = 0;

	for (int i = 0; i < picture->count; i++)
		count += picture->stroke[i].kind == kind && picture->stroke[i].token == token;
	return count;
}

static bool time_of(void *context, int step, char *out, size_t size)
{
	(void)context;
	snprintf(out, size, "2.5 s");
	return step == 1;
}

static void check_live(void)
{
	struct ladder *ladder = load("tests/golden/show-sfc-sequence/main.rung");
	uint8_t step[16] = { SFC_KNOWN, SFC_KNOWN | SFC_ACTIVE }, way[16] = { 0 };
	const struct sfc_live live = { step, way, time_of, NULL };
	struct sfc_sheet *sheet;
	struct picture picture;
	char *lines;

	if (!CHECK(ladder != NULL))
		return;
	way[1] = SFC_KNOWN | SFC_ENABLED;
	sheet = sfc_sheet_new(ladder_project(ladder), &ladder_project(ladder)->pou[0],
			      lettering);
	draw(sheet, &live, &picture);
	CHECK_AS(count_strokes(&picture, STROKE_FILL, TOKEN_POWER) == 1 &&
		 count_strokes(&picture, STROKE_FRAME, TOKEN_POWER) == 1,
		 "the active step is filled");
	CHECK_AS(count_strokes(&picture, STROKE_DISC, TOKEN_POWER) == 1,
		 "the active step has a dot besides its colour");
	CHECK_AS(count_strokes(&picture, STROKE_LINE, TOKEN_BLOCKS) == 1,
		 "the transition that waits is marked");
	lines = picture_lines(&picture);
	CHECK(strstr(lines, "2.5 s"));
	g_free(lines);
	picture_clear(&picture);
	sfc_sheet_free(sheet);
	ladder_free(ladder);
}

/* ---- differences ---- */

static struct sfc_sheet *sheet_of(struct ladder *ladder)
{
	return sfc_sheet_new(ladder_project(ladder), &ladder_project(ladder)->pou[0],
			     lettering);
}

/* With everything marked: signs and frames do not overlap other parts. */
static void check_marked(const char *path)
{
	struct ladder *ladder = load(path);
	struct sfc_scene scene = { .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
	struct sfc_sheet *sheet;
	struct sfc_mark *mark;
	struct picture picture;
	int count = 0;

	if (!CHECK_AS(ladder != NULL, path))
		return;
	sheet = sheet_of(ladder);
	mark = g_new0(struct sfc_mark, sheet->layout->shape_count +
		      sheet->layout->sfc->use_count + 1);
	for (int i = 0; i < sheet->layout->shape_count; i++)
		if (sheet->layout->shape[i].part != SFC_JUMP)
			mark[count++] = (struct sfc_mark){ i, -1, SFC_CHANGED };
	for (int i = 0; i < sheet->layout->sfc->use_count; i++)
		mark[count++] = (struct sfc_mark){ sheet->layout->sfc->use[i].step, i,
						   SFC_CHANGED };
	scene.sheet = sheet;
	scene.mark = mark;
	scene.mark_count = count;
	picture_init(&picture);
	sfc_draw(&scene, &picture);
	CHECK_AS(count_faults(&picture, sheet) == 0, "signs of differences have no overlaps");
	CHECK(count_strokes(&picture, STROKE_FRAME, TOKEN_FORCE) == count &&
	      count_strokes(&picture, STROKE_TEXT, TOKEN_FORCE) == count);
	picture_clear(&picture);
	g_free(mark);
	sfc_sheet_free(sheet);
	ladder_free(ladder);
}

/* ---- rungs of bodies ---- */

static const char chart[] =
	"RUNGBOARD 1\n\nPROGRAM Main SFC\n"
	"  INITIAL_STEP A:\n    Count(N);\n    More(N);\n  END_STEP\n\n"
	"  TRANSITION FROM A TO A:\n    RUNG\n      | NO I0.0 | COIL TRANSITION |\n"
	"  END_TRANSITION\n\n"
	"  ACTION Count:\n    RUNG\n      | NO I0.1 | COIL Q0.1 |\n"
	"    RUNG\n      | NO I0.2 | COIL Q0.2 |\n  END_ACTION\n\n"
	"  ACTION More:\n    RUNG\n      | NO I0.3 | COIL Q0.3 |\n  END_ACTION\n"
	"END_PROGRAM\n";

static struct rung *rung_of(LadderDocument *document, const char *text)
{
	struct diag_list why;

	diag_init(&why);
	return ladder_read_rung(ladder_document_ladder(document), text, strlen(text), &why);
}

static bool splice(LadderDocument *document, int at, int removed, const char *one,
		   const char *two)
{
	struct rung *rungs[2] = { one ? rung_of(document, one) : NULL,
				  two ? rung_of(document, two) : NULL };

	return ladder_document_splice(document, 0, at, removed, rungs,
				      (one != NULL) + (two != NULL), NULL);
}

static bool has_text(LadderDocument *document, const char *want)
{
	gsize len;
	char *text = ladder_document_text(document, &len);
	const bool has = strstr(text, want) != NULL;

	g_free(text);
	return has;
}

/* The cursor in a selection: a wash as of either, and one frame of 1.5 px. */
static void check_marks(const struct sfc_sheet *sheet)
{
	static const struct sfc_mark both[] = { { 0, -1, SFC_SELECTED }, { 0, -1, SFC_CURSOR } };
	const struct sfc_scene scene = { .sheet = sheet, .theme = theme_get(THEME_LIGHT, THEME_GREEN), .mark = both,
					 .mark_count = 2 };
	struct picture picture;
	int washes = 0, frames = 0;

	picture_init(&picture);
	sfc_draw(&scene, &picture);
	for (int i = 0; i < picture.count; i++) {
		const struct stroke *s = &picture.stroke[i];

		washes += s->kind == STROKE_FILL && s->token == TOKEN_ACCENT;
		frames += s->kind == STROKE_FRAME && s->token == TOKEN_ACCENT && s->width == 1.5f;
	}
	CHECK(washes == 1 && frames == 1);
	picture_clear(&picture);
}

/* A comment has the room up to the next thing at its height, not only up to the next branch. */
static void check_comment(void)
{
	static const char text[] = "RUNGBOARD 1\n\nPROGRAM P SFC\n"
		"  INITIAL_STEP S0: (* this comment stands above the branches and has room "
		"there *)\n  END_STEP\n\n"
		"  STEP S1:\n  END_STEP\n\n  STEP S2:\n  END_STEP\n\n"
		"  TRANSITION FROM S0 TO S1 := I0.0; END_TRANSITION\n\n"
		"  TRANSITION FROM S0 TO S2 := I0.1; END_TRANSITION\n\n"
		"  TRANSITION FROM S1 TO S0 := I0.2; END_TRANSITION\n\n"
		"  TRANSITION FROM S2 TO S0 := I0.3; END_TRANSITION\nEND_PROGRAM\n";
	LadderDocument *document = ladder_document_new();
	const struct project *project;
	struct sfc_sheet *sheet;
	struct picture picture;
	char *lines;

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	project = ladder_document_project(document);
	sheet = sfc_sheet_new(project, &project->pou[0], lettering);
	check_marks(sheet);
	draw(sheet, NULL, &picture);
	lines = picture_lines(&picture);
	CHECK_AS(strstr(lines, "above the branches") != NULL, "a comment above branches is not cut");
	CHECK(count_faults(&picture, sheet) == 0);
	g_free(lines);
	picture_clear(&picture);
	sfc_sheet_free(sheet);
	g_object_unref(document);
}

static void check_bodies(void)
{
	LadderDocument *document = ladder_document_new();
	const char *new = "RUNG\n| NO I0.7 | COIL Q0.7 |\n";

	ladder_document_open_text(document, NULL, chart, strlen(chart), true);
	CHECK_AS(!splice(document, 1, 0, new, NULL), "a rung between two bodies is refused");
	CHECK_AS(!splice(document, 0, 1, new, new), "a second rung of a condition is refused");
	CHECK_AS(!splice(document, 2, 2, new, NULL), "an edit across two bodies is refused");
	CHECK(has_text(document, chart));
	CHECK(splice(document, 1, 1, new, "RUNG\n| NO I0.1 | COIL Q0.1 |\n"));
	CHECK(has_text(document, "ACTION Count:\n    RUNG\n      | NO I0.7 | COIL Q0.7 |\n"
		       "    RUNG\n      | NO I0.1 | COIL Q0.1 |\n    RUNG\n"
		       "      | NO I0.2 | COIL Q0.2 |\n  END_ACTION\n"));
	CHECK(splice(document, 4, 1, new, NULL));
	CHECK(has_text(document, "ACTION More:\n    RUNG\n      | NO I0.7 | COIL Q0.7 |\n"));
	CHECK(splice(document, 0, 1, "RUNG\n| NO I1.0 | COIL TRANSITION |\n", NULL));
	CHECK(splice(document, 1, 2, new, NULL));
	CHECK(has_text(document, "ACTION Count:\n    RUNG\n      | NO I0.7 | COIL Q0.7 |\n"
		       "    RUNG\n      | NO I0.2 | COIL Q0.2 |\n  END_ACTION\n"));
	for (int i = 0; i < 4; i++)
		CHECK(ladder_document_undo(document));
	CHECK_AS(has_text(document, chart), "undo restores the same bytes");
	for (int i = 0; i < 4; i++)
		ladder_document_redo(document);
	CHECK(has_text(document, "| NO I1.0 | COIL TRANSITION |"));
	g_object_unref(document);
}

int main(void)
{
	lettering = lettering_new(NULL, NULL);
	check_chart("tests/golden/show-sfc-sequence/main.rung");
	check_chart("tests/golden/show-sfc-ways/main.rung");
	check_chart("ladders/sequence-s0-s8.rung");
	check_live();
	check_marked("tests/golden/show-sfc-sequence/main.rung");
	check_marked("tests/golden/show-sfc-ways/main.rung");
	check_marked("ladders/sequence-s0-s8.rung");
	check_marked("ladders/washing-machine.rung");
	check_comment();
	check_bodies();
	lettering_free(lettering);
	return tap_done();
}

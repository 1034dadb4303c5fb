/* SPDX-License-Identifier: MIT
 *
 * test_networks - networks in pixels: no text lies on another one or on a line, every part can be hit, live
 * values differ not only in colour, and marks stand where the part is.
 */
#include "editor-gtk/draw/fbd_draw.h"
#include "tests/editor/drawn.h"
#include "tests/tap.h"

#include <glib.h>

#define PROGRAM(lines) \
	"RUNGBOARD 1\nPROGRAM Main FBD\nVAR\n  Level, Limit : REAL;\n" \
	"  Ready, Stop, Start, Valve, Motor, Horn : BOOL;\n  Raw, Tare, Weight : INT;\n" \
	"  Delay : TON;\n  Pump_of_the_second_hall_behind_the_gate_1 : BOOL;\n  \xe6\xb0\xb4\xe6\xb3\xb5 : BOOL;\n" \
	"END_VAR\n" lines "END_PROGRAM\n"

static struct lettering *lettering;
static struct ladder *ladder;

static struct fbd_layout *lay_out(const char *text, int network)
{
	if (ladder)
		ladder_free(ladder);
	ladder = drawn_load("test.rung", text);
	return ladder ? fbd_layout_new(ladder_project(ladder), &ladder_project(ladder)->pou[0], network, lettering) :
			NULL;
}

static const char tank[] = PROGRAM(
	"(* The pump is another program's *)\n"
	"NETWORK Fill \"Fill the tank while there is room\"\n"
	"  Low := LT(IN1 := Level, IN2 := Limit)\n"
	"  Delay(IN := Low AND NOT Stop AND Ready, PT := T#3s)\n"
	"  Valve := Delay.Q\n"
	"NETWORK \"Weight\"\n"
	"  Diff := SUB(EN := Ready, IN1 := Raw, IN2 := Tare, ENO => Sure)  { at 3,1 }\n"
	"  Weight := LIMIT(MN := 0, IN := Diff, MX := 500)\n"
	"  Sum := ADD(PREVIOUS(Sum), Raw)\n"
	"  Horn S= Sure\n"
	"  Motor := (Start OR Motor OR Pump_of_the_second_hall_behind_the_gate_1) AND NOT \xe6\xb0\xb4\xe6\xb3\xb5\n"
	"  Tare := Sum\n"
	"NETWORK OFF\n"
	"  JMP Fill IF Stop\n"
	"  RETURN\n");

static void draw(const struct fbd_layout *layout, const struct fbd_live *live, const struct fbd_mark *mark,
		 unsigned int state, struct picture *picture)
{
	const struct fbd_scene scene = { .layout = layout, .live = live, .theme = theme_get(THEME_LIGHT, THEME_GREEN),
					 .mark = mark, .mark_count = mark ? 1 : 0, .state = state };

	picture_init(picture);
	fbd_draw(&scene, picture);
}

static bool has_text(const struct picture *picture, const char *text)
{
	for (int i = 0; i < picture->count; i++)
		if (picture->stroke[i].kind == STROKE_TEXT && strcmp(picture->stroke[i].text, text) == 0)
			return true;
	return false;
}

static int count(const struct picture *picture, enum stroke_kind kind, enum token token)
{
	int found = 0;

	for (int i = 0; i < picture->count; i++)
		found += picture->stroke[i].kind == kind && picture->stroke[i].token == token;
	return found;
}

/* ---- nothing lies on a text ---- */

static int faults(const struct picture *picture, const struct fbd_layout *layout)
{
	int sum = 0;

	for (int i = 0; i < picture->count; i++) {
		const struct stroke *a = &picture->stroke[i];
		const bool outside = a->x < 0 || a->y < 0 || a->x > layout->width || a->y > layout->height;

		if (outside && sum++ == 0)
			printf("# outside: %g, %g\n", (double)a->x, (double)a->y);
		if (a->kind != STROKE_TEXT || a->letter == LETTER_BADGE)
			continue;
		for (int k = 0; k < picture->count; k++) {
			const struct stroke *b = &picture->stroke[k];
			const bool over = b->kind == STROKE_TEXT ? k > i && meet(ink_of(a), ink_of(b)) :
					  b->kind == STROKE_LINE && crosses(ink_of(a), b);

			if (over && sum++ == 0)
				printf("# \"%s\" at %g, %g, %s\n", a->text, (double)a->x, (double)a->y,
				       b->kind == STROKE_TEXT ? b->text : "a line");
		}
	}
	return sum;
}

static unsigned int numbers(void *context, int pin, char *text, size_t size)
{
	(void)context;
	g_snprintf(text, size, "%d.5", pin * 1000);
	return LIVE_KNOWN;
}

static void texts_are_free(void)
{
	const struct fbd_live live = { numbers, NULL, NULL };

	for (int i = 0; i < 3; i++) {
		struct fbd_layout *layout = lay_out(tank, i);
		struct picture picture;

		if (!CHECK(layout != NULL))
			return;
		draw(layout, NULL, NULL, 0, &picture);
		CHECK_AS(faults(&picture, layout) == 0, "nothing lies on a text");
		picture_clear(&picture);
		draw(layout, &live, NULL, 0, &picture);
		CHECK_AS(faults(&picture, layout) == 0, "nor on a value");
		picture_clear(&picture);
		fbd_layout_free(layout);
	}
}

static void says_all(void)
{
	static const char *const words[] = { "1", "Fill:", "Fill the tank while there is room",
		"The pump is another program's", "LT", "IN1", "Level", "Low", "AND", "TON", "Delay", "T#3s", "ET",
		"Valve" };
	struct fbd_layout *layout = lay_out(tank, 0);
	struct picture picture;

	draw(layout, NULL, NULL, 0, &picture);
	for (size_t i = 0; i < G_N_ELEMENTS(words); i++)
		CHECK_AS(has_text(&picture, words[i]), words[i]);
	CHECK(count(&picture, STROKE_ARC, TOKEN_INK) == 1); /* the circle at Stop */
	CHECK(count(&picture, STROKE_ARC, TOKEN_ACCENT) == 3); /* the order */
	picture_clear(&picture);
	fbd_layout_free(layout);
	layout = lay_out(tank, 2);
	draw(layout, NULL, NULL, 0, &picture);
	CHECK(has_text(&picture, "OFF") && has_text(&picture, ">>") && has_text(&picture, "RETURN"));
	CHECK(count(&picture, STROKE_FRAME, TOKEN_INK) == 0 && count(&picture, STROKE_FRAME, TOKEN_COMMENT) == 2);
	picture_clear(&picture);
	fbd_layout_free(layout);
}

/* ---- live ---- */

static unsigned int bits(void *context, int pin, char *text, size_t size)
{
	(void)context;
	(void)text;
	(void)size;
	return LIVE_KNOWN | (pin % 2 ? 0 : LIVE_OUT);
}

static unsigned int half_done(void *context, int box, float *part)
{
	(void)context;
	*part = box == 2 ? 0.5f : -1;
	return LIVE_KNOWN | LIVE_OUT;
}

static void power_is_seen(void)
{
	const struct theme *theme = theme_get(THEME_LIGHT, THEME_GREEN);
	const struct fbd_live live = { bits, half_done, NULL };
	struct fbd_layout *layout = lay_out(tank, 0);
	struct picture picture;
	int thick = 0, thin = 0, pale = 0, frames = 0;

	draw(layout, &live, NULL, 0, &picture);
	for (int i = 0; i < picture.count; i++) {
		const struct stroke *s = &picture.stroke[i];

		thick += s->kind == STROKE_LINE && s->token == TOKEN_POWER && s->width == theme->power_width;
		thin += s->kind == STROKE_LINE && s->token == TOKEN_IDLE && s->width == theme->idle_width;
		pale += s->token == TOKEN_POWER && s->width > 0 && s->width != theme->power_width;
		frames += s->kind == STROKE_FRAME && s->token == TOKEN_POWER;
	}
	CHECK(thick > 0 && thin > 0 && frames > 0);
	CHECK_AS(pale == 0, "power is never told by its colour alone: wires, circles and boxes with it are thicker");
	CHECK(count(&picture, STROKE_FILL, TOKEN_LINE) == 2); /* the bar of the timer; the end of the strip */
	picture_clear(&picture);
	fbd_layout_free(layout);
}

/* The cursor in a selection: a wash as of either, and one frame. */
static void marks_are_one(void)
{
	static const struct fbd_mark both[] = { { 0, -1, MARK_SELECTED }, { 0, -1, MARK_CURSOR } };
	struct fbd_layout *layout = lay_out(tank, 0);
	const struct fbd_scene scene = { .layout = layout, .theme = theme_get(THEME_LIGHT, THEME_GREEN), .mark = both,
					 .mark_count = 2 };
	struct picture picture;

	picture_init(&picture);
	fbd_draw(&scene, &picture);
	CHECK(count(&picture, STROKE_FILL, TOKEN_ACCENT) == 1 && count(&picture, STROKE_FRAME, TOKEN_ACCENT) == 1);
	picture_clear(&picture);
	fbd_layout_free(layout);
}

/* ---- places ---- */

static void parts_are_hit(void)
{
	struct fbd_layout *layout = lay_out(tank, 1);
	int missed = 0;

	for (int i = 0; i < layout->graph.box_count; i++) {
		const graphene_rect_t r = fbd_layout_box(layout, i);
		const struct fbd_hit hit = fbd_layout_hit(layout, r.origin.x + r.size.width / 2,
							  r.origin.y + 5, 0);

		missed += hit.box != i;
	}
	CHECK_AS(missed == 0, "the head of each box hits it");
	for (int i = missed = 0; i < layout->graph.pin_count; i++) {
		const graphene_point_t at = fbd_layout_pin(layout, i);
		const struct fbd_hit hit = fbd_layout_hit(layout, at.x, at.y, 2);

		missed += layout->graph.box[layout->graph.pin[i].box].kind != FBD_VALUE && hit.pin != i;
		if (!layout->graph.pin[i].operand)
			continue;
		const graphene_rect_t r = fbd_layout_operand(layout, i);
		const struct fbd_hit text = fbd_layout_hit(layout, r.origin.x + r.size.width / 2, at.y, 2);

		missed += text.pin != i || text.part != FBD_PART_OPERAND;
	}
	CHECK_AS(missed == 0, "each pin, and the text at it");
	for (int i = missed = 0; i < layout->plan.segment_count; i++) {
		const struct fbd_segment *s = &layout->plan.segment[i];
		const struct fbd_hit hit = fbd_layout_hit(layout, layout->left + (s->x1 + s->x2) / 2,
			(fbd_layout_y(layout, s->row1) + fbd_layout_y(layout, s->row2)) / 2, 3);

		missed += hit.part != FBD_PART_WIRE && hit.part != FBD_PART_PIN;
	}
	CHECK_AS(missed == 0, "each stroke of a wire");
	CHECK(fbd_layout_hit(layout, 10, 20, 2).part == FBD_PART_NUMBER);
	CHECK(fbd_layout_hit(layout, 200, 20, 2).part == FBD_PART_TITLE);
	fbd_layout_free(layout);
}

/* The hint of the place where a box stands puts it there again. */
static void hints_come_back(void)
{
	struct fbd_layout *layout = lay_out(tank, 1);
	int wrong = 0, column, row;

	for (int i = 0; i < layout->graph.box_count; i++) {
		const graphene_rect_t r = fbd_layout_box(layout, i);

		if (layout->graph.box[i].kind == FBD_VALUE || fbd_is_end(&layout->graph.box[i]))
			continue;
		fbd_layout_hint(layout, i, r.origin.x, r.origin.y, &column, &row);
		wrong += column != layout->plan.box[i].column + 1 || row != layout->plan.box[i].top + 1;
	}
	CHECK(wrong == 0);
	CHECK(layout->plan.box[0].column == 2 && layout->plan.box[0].top == 0); /* { at 3,1 } */
	fbd_layout_free(layout);
}

static void mistakes_are_marked(void)
{
	struct fbd_layout *layout = lay_out(tank, 0);
	const struct fbd_graph *graph = &layout->graph;
	struct fbd_mark mark = { -1, -1, MARK_ERROR };
	struct diag diag = { .line = graph->pin[0].line, .column = graph->pin[0].column };
	struct picture picture;

	CHECK(fbd_layout_of_diag(layout, &diag, &mark.box, &mark.pin) && mark.pin == 0 && mark.box == 0);
	draw(layout, NULL, &mark, 0, &picture);
	CHECK(count(&picture, STROKE_WAVE, TOKEN_ERROR) == 1);
	picture_clear(&picture);
	diag.line = 1;
	CHECK(!fbd_layout_of_diag(layout, &diag, &mark.box, &mark.pin));
	fbd_layout_free(layout);
}

int main(void)
{
	PangoContext *context = lettering_context();

	lettering = lettering_new(context, NULL);
	texts_are_free();
	says_all();
	power_is_seen();
	marks_are_one();
	parts_are_hit();
	hints_come_back();
	mistakes_are_marked();
	lettering_free(lettering);
	g_object_unref(context);
	if (ladder)
		ladder_free(ladder);
	return tap_done();
}

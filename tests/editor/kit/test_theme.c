/* SPDX-License-Identifier: MIT
 *
 * test_theme - legibility and contrast, computed from the token table.
 *
 * WCAG 2.1: text 4.5 : 1 (1.4.3), graphics 3 : 1 (1.4.11).
 */
#include "editor-gtk/kit/theme.h"
#include "tests/tap.h"

#include <math.h>

static double linear(double part)
{
	return part <= 0.04045 ? part / 12.92 : pow((part + 0.055) / 1.055, 2.4);
}

/* Relative luminance, WCAG 2.1. */
static double luminance(const GdkRGBA *color)
{
	return 0.2126 * linear((double)color->red) +
	       0.7152 * linear((double)color->green) +
	       0.0722 * linear((double)color->blue);
}

/* WCAG 2 contrast ratio of two opaque colours, 1 to 21. */
static double theme_contrast(const GdkRGBA *a, const GdkRGBA *b)
{
	double one = luminance(a), two = luminance(b);

	return one > two ? (one + 0.05) / (two + 0.05) : (two + 0.05) / (one + 0.05);
}

/* @over with opacity @alpha upon @ground. */
static GdkRGBA theme_mix(const GdkRGBA *over, float alpha, const GdkRGBA *ground)
{
	float rest = 1 - alpha;

	return (GdkRGBA){ over->red * alpha + ground->red * rest,
			  over->green * alpha + ground->green * rest,
			  over->blue * alpha + ground->blue * rest, 1 };
}

static const enum token texts[] = { TOKEN_INK, TOKEN_ERROR, TOKEN_ACCENT, TOKEN_COMMENT };
static const enum token graphics[] = { TOKEN_IDLE, TOKEN_POWER, TOKEN_FORCE,
					TOKEN_BLOCKS };

static int failed;

static void at_least(const char *theme, enum token token, const char *ground,
		     double ratio, double wanted)
{
	if (ratio >= wanted)
		return;
	failed++;
	printf("# %s: %s upon %s has %.2f, wants %.1f\n", theme, token_name(token), ground,
	       ratio, wanted);
}

/* On the sheet, and on everything that is laid over it. */
static void check_theme(const struct theme *theme, const char *name)
{
	const GdkRGBA *c = theme->color, *sheet = &c[TOKEN_SHEET];
	const struct { const char *name; GdkRGBA color; } ground[] = {
		{ "the sheet", *sheet },
		{ "the gutter", c[TOKEN_GUTTER] },
		{ "the cursor", theme_mix(&c[TOKEN_ACCENT], theme->wash, sheet) },
		{ "a closed contact", theme_mix(&c[TOKEN_POWER], theme->fill, sheet) },
		{ "what a search found", c[TOKEN_FOUND] },
		{ "the current one of that", c[TOKEN_FOUND_NOW] },
		{ "an added rung", theme_mix(&c[TOKEN_POWER], 0.10f, sheet) },
		{ "a removed rung", theme_mix(&c[TOKEN_ERROR], 0.10f, sheet) },
	};

	for (size_t g = 0; g < G_N_ELEMENTS(ground); g++) {
		at_least(name, TOKEN_INK, ground[g].name,
			 theme_contrast(&c[TOKEN_INK], &ground[g].color), 4.5);
		for (size_t i = 0; i < G_N_ELEMENTS(texts); i++)
			at_least(name, texts[i], ground[g].name,
				 theme_contrast(&c[texts[i]], &ground[g].color), 4.5);
		for (size_t i = 0; i < G_N_ELEMENTS(graphics); i++)
			at_least(name, graphics[i], ground[g].name,
				 theme_contrast(&c[graphics[i]], &ground[g].color), 3);
	}
	at_least(name, TOKEN_BADGE, "a badge",
		 theme_contrast(&c[TOKEN_BADGE], &c[TOKEN_FORCE]), 4.5);
	at_least(name, TOKEN_BADGE, "a badge of what failed",
		 theme_contrast(&c[TOKEN_BADGE], &c[TOKEN_ERROR]), 4.5);
	at_least(name, TOKEN_BADGE, "a note",
		 theme_contrast(&c[TOKEN_BADGE], &c[TOKEN_BLOCKS]), 4.5);
}

int main(void)
{
	static const char *const name[THEME_KINDS] = { "light", "dark", "contrast",
						       "dark contrast", "print" };
	const GdkRGBA black = { 0, 0, 0, 1 }, white = { 1, 1, 1, 1 };
	GdkRGBA grey = theme_mix(&black, 0.5f, &white);

	CHECK(theme_contrast(&black, &white) > 20.99);
	CHECK(theme_contrast(&white, &white) < 1.01);
	CHECK(grey.red > 0.49f && grey.red < 0.51f && grey.alpha > 0.99f);
	for (int kind = 0; kind < THEME_KINDS; kind++)
		for (int power = 0; power < THEME_POWERS; power++) {
			const struct theme *theme = theme_get(kind, power);

			failed = 0;
			check_theme(theme, name[kind]);
			CHECK_AS(failed == 0, name[kind]);
			/* No meaning has only a colour. */
			CHECK(theme->power_width >= 2 * theme->idle_width);
			CHECK(theme->fill > 0.1f);
		}
	for (int kind = THEME_CONTRAST; kind <= THEME_CONTRAST_DARK; kind++) {
		const struct theme *theme = theme_get(kind, THEME_GREEN);

		CHECK(theme_contrast(&theme->color[TOKEN_INK], &theme->color[TOKEN_SHEET]) >
		      20);
		for (size_t i = 0; i < G_N_ELEMENTS(texts); i++)
			at_least(name[kind], texts[i], "the sheet",
				 theme_contrast(&theme->color[texts[i]],
						&theme->color[TOKEN_SHEET]), 7);
		CHECK_AS(failed == 0, "with high contrast texts have 7 : 1");
	}
	return tap_done();
}

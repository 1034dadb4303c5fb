/* SPDX-License-Identifier: MIT
 *
 * lettering - measuring text and remembering it; see lettering.h.
 */
#include "editor-gtk/kit/lettering.h"

#include <glib.h>
#include <pango/pangocairo.h>
#include <string.h>

#define PT (96.0f / 72)
#define TRIM_AT   20000 /* texts remembered                                     */
#define LAID_MOST 2000  /* of a style, laid out: 2 KB each                      */
#define ELLIPSIS "\xe2\x80\xa6"

static const struct letter_style style[LETTERS] = {
	[LETTER_SYMBOL]  = { "symbol", 10 * PT, PANGO_WEIGHT_SEMIBOLD, false },
	[LETTER_ADDRESS] = { "address", 8.5f * PT, PANGO_WEIGHT_NORMAL, true },
	[LETTER_TITLE]   = { "title", 10.5f * PT, PANGO_WEIGHT_BOLD, false },
	[LETTER_COMMENT] = { "comment", 9.5f * PT, PANGO_WEIGHT_NORMAL, false },
	[LETTER_NUMBER]  = { "number", 10.5f * PT, PANGO_WEIGHT_BOLD, false },
	[LETTER_TYPE]    = { "type", 9.5f * PT, PANGO_WEIGHT_BOLD, false },
	[LETTER_PIN]     = { "pin", 8.5f * PT, PANGO_WEIGHT_NORMAL, false },
	[LETTER_OPERAND] = { "operand", 9 * PT, PANGO_WEIGHT_NORMAL, true },
	[LETTER_VALUE]   = { "value", 8.5f * PT, PANGO_WEIGHT_BOLD, true },
	[LETTER_BADGE]   = { "badge", 7.5f * PT, PANGO_WEIGHT_BOLD, false },
	[LETTER_HEADING] = { "heading", 14 * PT, PANGO_WEIGHT_BOLD, false },
};

struct known {
	enum letter letter;
	int bound;           /* 1/64 px: of two bounds that differ by less one may fit */
	float width;
	char *fit;           /* the text as drawn                              */
	size_t len;
	char text[];         /* the text as given                              */
};

struct lettering {
	PangoContext *context;
	PangoLayout *layout[LETTERS]; /* for measuring                          */
	GHashTable *known;
	/* Laid out texts: shaping is most of the cost of a drawing. */
	GHashTable *laid[LETTERS];
	struct spelling_rule rule;
	bool spells;
};

const struct letter_style *letter_style(enum letter letter)
{
	return &style[letter];
}

static guint known_hash(gconstpointer key)
{
	const struct known *known = key;
	guint hash = 2166136261u ^ (guint)known->letter ^ (guint)known->bound << 8;

	for (size_t i = 0; i < known->len; i++)
		hash = (hash ^ (guchar)known->text[i]) * 16777619u;
	return hash;
}

static gboolean known_equal(gconstpointer a, gconstpointer b)
{
	const struct known *x = a, *y = b;

	return x->letter == y->letter && x->bound == y->bound && x->len == y->len &&
	       memcmp(x->text, y->text, x->len) == 0;
}

static void known_free(gpointer pointer)
{
	struct known *known = pointer;

	g_free(known->fit);
	g_free(known);
}

static PangoLayout *layout_new(PangoContext *context, const char *family,
			       const struct letter_style *of)
{
	PangoLayout *layout = pango_layout_new(context);
	PangoFontDescription *font = pango_font_description_new();

	pango_font_description_set_family(font, of->mono ?
		"DejaVu Sans Mono, Noto Sans Mono, Noto Sans Mono CJK SC, monospace" :
		family ? family :
		"Cantarell, Inter, Noto Sans, Noto Sans CJK SC, sans-serif");
	pango_font_description_set_weight(font, of->weight);
	pango_font_description_set_absolute_size(font, (double)of->size * PANGO_SCALE);
	pango_layout_set_font_description(layout, font);
	pango_font_description_free(font);
	pango_layout_set_single_paragraph_mode(layout, TRUE);
	pango_layout_set_auto_dir(layout, FALSE);
	return layout;
}

PangoContext *lettering_context(void)
{
	PangoFontMap *map = pango_cairo_font_map_get_default();
	PangoContext *context = pango_font_map_create_context(map);
	cairo_font_options_t *options = cairo_font_options_create();

	/* Widths are the same at every zoom and on every surface. */
	cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
	cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
	cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
	pango_cairo_context_set_font_options(context, options);
	pango_cairo_context_set_resolution(context, 96);
	pango_context_set_round_glyph_positions(context, FALSE);
	cairo_font_options_destroy(options);
	return context;
}

struct lettering *lettering_new(PangoContext *context, const char *family)
{
	struct lettering *lettering = g_new0(struct lettering, 1);

	lettering->context = context ? g_object_ref(context) : NULL;
	for (int i = 0; context && i < LETTERS; i++)
		lettering->layout[i] = layout_new(context, family, &style[i]);
	for (int i = 0; i < LETTERS; i++)
		lettering->laid[i] = g_hash_table_new_full(g_str_hash, g_str_equal, g_free,
							   g_object_unref);
	lettering->known = g_hash_table_new_full(known_hash, known_equal, NULL,
						 known_free);
	return lettering;
}

void lettering_free(struct lettering *lettering)
{
	if (!lettering)
		return;
	for (int i = 0; i < LETTERS; i++) {
		g_clear_object(&lettering->layout[i]);
		g_hash_table_unref(lettering->laid[i]);
	}
	g_hash_table_unref(lettering->known);
	g_clear_object(&lettering->context);
	g_free(lettering);
}

void lettering_spell(struct lettering *lettering, struct spelling_rule rule)
{
	lettering->rule = rule;
	lettering->spells = true;
	g_hash_table_remove_all(lettering->known);
}

void lettering_trim(struct lettering *lettering)
{
	if (g_hash_table_size(lettering->known) > TRIM_AT)
		g_hash_table_remove_all(lettering->known);
	for (int i = 0; i < LETTERS; i++)
		if (g_hash_table_size(lettering->laid[i]) > LAID_MOST)
			g_hash_table_remove_all(lettering->laid[i]);
}

/* Without fonts: wide characters 1 em, others 0.6. */
static float by_rule(enum letter letter, const char *text, size_t len)
{
	float width = 0;

	for (const char *at = text; at < text + len; at = g_utf8_next_char(at))
		width += g_unichar_iswide(g_utf8_get_char(at)) ? 1 : 0.6f;
	return width * style[letter].size;
}

static float measure(struct lettering *lettering, enum letter letter, const char *text,
		     size_t len)
{
	PangoLayout *layout = lettering->layout[letter];
	PangoRectangle box;

	if (!layout)
		return by_rule(letter, text, len);
	pango_layout_set_text(layout, text, (int)len);
	pango_layout_get_extents(layout, NULL, &box);
	return (float)box.width / PANGO_SCALE;
}

/* Is the character part of the one before it, so that the text must not be cut there? */
static bool clings(const char *at)
{
	gunichar c = g_utf8_get_char(at);

	return c == 0x200d || g_unichar_ismark(c) || (c >= 0xfe00 && c <= 0xfe0f) ||
	       (c >= 0x1f3fb && c <= 0x1f3ff);
}

/* The longest beginning that fits with an ellipsis, found by bisection. */
static char *shorten(struct lettering *lettering, enum letter letter, const char *text,
		     float bound)
{
	long low = 0, high = g_utf8_strlen(text, -1);

	while (low < high) {
		long middle = (low + high + 1) / 2;
		size_t len = (size_t)(g_utf8_offset_to_pointer(text, middle) - text);
		char *tried = g_strdup_printf("%.*s" ELLIPSIS, (int)len, text);

		if (measure(lettering, letter, tried, strlen(tried)) <= bound)
			low = middle;
		else
			high = middle - 1;
		g_free(tried);
	}
	const char *end = g_utf8_offset_to_pointer(text, low);
	while (end > text && clings(end))
		end = g_utf8_prev_char(end);
	return g_strdup_printf("%.*s" ELLIPSIS, (int)(end - text), text);
}

static char *harmless(const char *text, size_t len)
{
	char *valid = g_utf8_make_valid(text, (gssize)len);

	for (char *at = valid; *at; at = g_utf8_next_char(at)) {
		if ((guchar)*at < 0x20 || *at == 0x7f)
			*at = ' ';
		else if ((guchar)at[0] == 0xc2 && (guchar)at[1] < 0xa0)
			memcpy(at, "??", 2);
	}
	return valid;
}

/* @text: taken over. */
static char *spelled(const struct lettering *lettering, enum letter letter, char *text)
{
	char *other;

	if (!lettering->spells ||
	    (letter != LETTER_SYMBOL && letter != LETTER_ADDRESS && letter != LETTER_OPERAND))
		return text;
	other = spelling_text(&lettering->rule, text);
	g_free(text);
	return other;
}

static struct known *learn(struct lettering *lettering, const struct known *key,
			   const char *text, float bound)
{
	struct known *known = g_malloc(sizeof(*known) + key->len + 1);

	*known = *key;
	memcpy(known->text, text, key->len + 1);
	known->fit = spelled(lettering, key->letter, harmless(text, key->len));
	known->width = measure(lettering, key->letter, known->fit, strlen(known->fit));
	if (bound > 0 && known->width > bound) {
		char *whole = known->fit;

		known->fit = shorten(lettering, key->letter, whole, bound);
		known->width = measure(lettering, key->letter, known->fit,
				       strlen(known->fit));
		g_free(whole);
	}
	g_hash_table_add(lettering->known, known);
	return known;
}

struct lettered lettering_fit(struct lettering *lettering, enum letter letter,
			      const char *text, ptrdiff_t len, float bound)
{
	size_t size = len < 0 ? strlen(text) : (size_t)len;
	size_t room = sizeof(struct known) + size + 1;
	char small[sizeof(struct known) + 256];
	struct known *key = room <= sizeof(small) ? (struct known *)(void *)small :
						    g_malloc(room);

	memset(key, 0, sizeof(*key));
	key->letter = letter;
	key->bound = (int)(bound * 64);
	key->len = size;
	memcpy(key->text, text, size);
	key->text[size] = 0;
	struct known *known = g_hash_table_lookup(lettering->known, key);
	if (!known)
		known = learn(lettering, key, key->text, bound);
	if ((char *)key != small)
		g_free(key);
	return (struct lettered){ known->fit, known->width };
}

static size_t wrap_by_rule(enum letter letter, const char *text, float width)
{
	const char *end = text;

	while (*end && (end == text ||
			by_rule(letter, text, (size_t)(g_utf8_next_char(end) - text)) <=
			width))
		end = g_utf8_next_char(end);
	return (size_t)(end - text);
}

static PangoLayout *wrapped(struct lettering *lettering, enum letter letter, const char *text,
			    float width)
{
	PangoLayout *layout = lettering->layout[letter];

	pango_layout_set_text(layout, text, -1);
	pango_layout_set_width(layout, (int)(width * PANGO_SCALE));
	pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
	return layout;
}

size_t lettering_wrap(struct lettering *lettering, enum letter letter, const char *text,
		      float width)
{
	if (!lettering->layout[letter])
		return wrap_by_rule(letter, text, width);
	PangoLayout *layout = wrapped(lettering, letter, text, width);
	PangoLayoutLine *line = pango_layout_get_line_count(layout) > 1 ?
		pango_layout_get_line_readonly(layout, 1) : NULL;
	size_t fits = line ? (size_t)line->start_index : strlen(text);
	pango_layout_set_width(layout, -1);
	return fits;
}

int lettering_lines(struct lettering *lettering, enum letter letter, const char *text,
		    float width)
{
	int lines = 0;

	if (lettering->layout[letter]) {
		lines = pango_layout_get_line_count(wrapped(lettering, letter, text, width));
		pango_layout_set_width(lettering->layout[letter], -1);
		return lines;
	}
	do {
		text += wrap_by_rule(letter, text, width);
		lines++;
	} while (*text);
	return lines;
}

struct lettered lettering_line(struct lettering *lettering, enum letter letter,
			       const char **text, float width, bool last)
{
	const char *line = *text;
	size_t len = lettering_wrap(lettering, letter, line, width);

	if (last && line[len]) {
		*text += strlen(line);
		return lettering_fit(lettering, letter, line, -1, width);
	}
	*text += len;
	while (len > 1 && line[len - 1] == ' ')
		len--;
	return lettering_fit(lettering, letter, line, (ptrdiff_t)len, 0);
}

PangoLayout *lettering_layout(struct lettering *lettering, enum letter letter,
			      const char *text, float *baseline)
{
	PangoLayout *layout = g_hash_table_lookup(lettering->laid[letter], text);

	if (!layout) {
		layout = pango_layout_copy(lettering->layout[letter]);
		pango_layout_set_text(layout, text, -1);
		if (g_hash_table_size(lettering->laid[letter]) > 2 * LAID_MOST)
			g_hash_table_remove_all(lettering->laid[letter]);
		g_hash_table_insert(lettering->laid[letter], g_strdup(text), layout);
	}
	*baseline = (float)pango_layout_get_baseline(layout) / PANGO_SCALE;
	return layout;
}

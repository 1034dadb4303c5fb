/* SPDX-License-Identifier: MIT
 *
 * diff_say - one difference in words, or as a JSON object.
 *
 * In words long texts are clipped; JSON has them whole.
 */
#include "engine/compare/diff.h"
#include "engine/base/plain.h"

#include <string.h>
#include <strings.h>

#define SAY_CLIP 72 /* columns of one side of a change */

static void say_clipped(const struct sink *sink, const char *text)
{
	size_t len = strlen(text);
	int width;
	size_t fits = plain_clip(text, len, SAY_CLIP, &width);

	plain_write(sink, text, fits);
	if (fits < len)
		sink_text(sink, "…");
}

static void say_side(const struct sink *sink, const char *text)
{
	if (*text)
		say_clipped(sink, text);
	else
		sink_text(sink, "nothing");
}

/* A word of the place, with a blank before all but the first. */
static void say_word(const struct sink *sink, const char **gap,
		     const char *word)
{
	if (!word || !*word)
		return;
	sink_text(sink, *gap);
	say_clipped(sink, word);
	*gap = " ";
}

static void say_place(const struct sink *sink, const struct difference *what)
{
	const char *gap = "";

	say_word(sink, &gap, what->pou);
	if (what->rung) {
		sink_printf(sink, "%srung %d", gap, what->rung);
		gap = " ";
		if (what->label && *what->label) {
			sink_text(sink, " (");
			say_clipped(sink, what->label);
			sink_text(sink, ")");
		}
	}
	if (what->row) {
		sink_printf(sink, "%scell (%d,%d)", gap, what->row, what->col);
		gap = " ";
	}
	if (what->line) {
		sink_printf(sink, "%sline %d", gap, what->line);
		gap = " ";
	}
	say_word(sink, &gap, what->kind);
	say_word(sink, &gap, what->subject);
}

static void say_words(const struct sink *sink, const struct difference *what)
{
	say_place(sink, what);
	sink_text(sink, ": ");
	if (what->property)
		sink_printf(sink, "%s ", what->property);
	if (what->change) {
		sink_text(sink, what->change);
	} else {
		say_side(sink, what->from);
		sink_text(sink, " -> ");
		say_side(sink, what->to);
	}
	sink_text(sink, "\n");
}

static void json_number(const struct sink *sink, const char **gap,
			const char *name, int number)
{
	if (number) {
		sink_printf(sink, "%s\"%s\": %d", *gap, name, number);
		*gap = ", ";
	}
}

static void json_field(const struct sink *sink, const char **gap,
		       const char *name, const char *text)
{
	if (text) {
		sink_printf(sink, "%s\"%s\": ", *gap, name);
		sink_json_text(sink, text);
		*gap = ", ";
	}
}

static void say_json(const struct sink *sink, const struct difference *what)
{
	const char *gap = "";

	sink_text(sink, "{");
	json_field(sink, &gap, "pou", what->pou);
	json_number(sink, &gap, "rung", what->rung);
	if (what->label && *what->label)
		json_field(sink, &gap, "label", what->label);
	json_number(sink, &gap, "row", what->row);
	json_number(sink, &gap, "col", what->col);
	json_number(sink, &gap, "line", what->line);
	json_field(sink, &gap, "kind", what->kind);
	json_field(sink, &gap, "subject", what->subject);
	json_field(sink, &gap, "property", what->property);
	json_field(sink, &gap, "change",
		   what->change ? what->change : "changed");
	json_field(sink, &gap, "from", what->from);
	json_field(sink, &gap, "to", what->to);
	sink_text(sink, "}");
}

/* Not what others draw, and nothing of another POU if one is wanted. */
static bool is_wanted(const struct diff *diff, const struct difference *what)
{
	const char *pou = what->pou ? what->pou : what->subject ? what->subject : "";

	return !diff->besides || (!what->rung && !what->line &&
				  (!diff->pou || strcasecmp(diff->pou, pou) == 0));
}

void diff_say(struct diff *diff, struct difference what)
{
	if (!is_wanted(diff, &what)) {
		diff->count++;
		return;
	}
	diff->said++;
	if (diff->json) {
		sink_text(diff->sink, diff->count ? ",\n " : "\n ");
		say_json(diff->sink, &what);
	} else {
		say_words(diff->sink, &what);
	}
	diff->count++;
}

void diff_texts(struct diff *diff, struct difference what, const char *property,
		const char *from, const char *to)
{
	if (strcmp(from, to) == 0)
		return;
	what.property = property;
	what.from = from;
	what.to = to;
	diff_say(diff, what);
}

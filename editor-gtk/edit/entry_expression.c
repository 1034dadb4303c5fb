/* SPDX-License-Identifier: MIT
 *
 * entry_expression - a comparison or an assignment, typed with or without brackets.
 *
 * The engine parses it; here its names are looked up, and the new ones given a type.
 */
#include "editor-gtk/edit/entry_inside.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/model/expr.h"

#include <stdlib.h>
#include <string.h>

/* A name with what the line says of it, `Level AT %IW0 : INT`. */
struct said {
	const char *text;
	size_t len, name;    /* bytes, and of the name in them                 */
	enum iec_type type;  /* IEC_NONE: it does not say it                   */
};

/* What does not fit a small stack. */
struct work {
	struct expr expr;
	struct diag_list diags;
	struct entry_target target;
	struct entry_types types;
	struct said said[ENTRY_NEW_MOST];
	int said_count;
};

/* Only what a person would call a type; an error is found when the name is declared. */
static enum iec_type type_said(const struct said *said)
{
	const char *end = said->text + said->len, *at = end;

	while (at > said->text && at[-1] != ':') /* the last one: I:0/3 has one, too */
		at--;
	while (at < end && (*at == ' ' || *at == '\t'))
		at++;
	return iec_type_find(at, (size_t)(end - at));
}

static bool keep_said(struct lex *lex, struct work *w, struct entry *entry)
{
	const char *text = lex->token.text;
	const size_t len = entry_said_len(text, (size_t)(lex->end - text));
	struct said *said = &w->said[w->said_count];

	if (len == 0)
		return true;
	if (w->said_count == ENTRY_NEW_MOST)
		return entry_wrong(entry, N_("too many new names in one line"), text,
				   lex->token.len);
	*said = (struct said){ text, len, lex->token.len, IEC_NONE };
	said->type = type_said(said);
	w->said_count++;
	lex->at = text + len;
	return true;
}

/* With one blank round := and comparisons, one where there were some, else none; and
 * without what is said of names. */
static bool print(const char *text, size_t len, struct work *w, struct entry *entry)
{
	static const char *const wide[] = { ":=", "<", ">", "<=", ">=", "=", "<>" };
	char *out = entry->operand;
	const size_t size = sizeof(entry->operand);
	struct lex lex;
	bool before = false, first = true, good = true;

	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END && good) {
		bool sign = false;

		for (size_t i = 0; i < sizeof(wide) / sizeof(*wide); i++)
			sign |= lex.token.kind == TOKEN_SYMBOL && lex_is(&lex, wide[i]);
		if (!first && (before || sign || lex.token.space_before))
			good = entry_append(out, size, " ", 1);
		good = good && entry_append(out, size, lex.token.text, lex.token.len);
		before = sign;
		first = false;
		if (!keep_said(&lex, w, entry))
			return false;
	}
	return good || entry_wrong(entry, N_("this line is too long"), "", 0);
}

static const struct said *said_of(const struct work *w, const char *name, size_t len)
{
	for (int i = 0; i < w->said_count; i++)
		if (w->said[i].name == len && ascii_same(w->said[i].text, name, len))
			return &w->said[i];
	return NULL;
}

static enum iec_type type_of(void *context, const char *name, size_t len)
{
	const struct said *said = said_of(context, name, len);

	return said ? said->type : IEC_NONE;
}

static bool look_up(const struct entry_place *place, const char *text, size_t len,
		    enum iec_type type, bool write, struct work *w, struct entry *entry)
{
	const struct said *said = said_of(w, text, len);
	struct entry_fit fit = entry_fit_type(type, write);

	if (said && said->type == type)
		fit.classes = iec_type_row(type)->class;
	if (!entry_operand(place, said ? said->text : text, said ? said->len : len, &fit,
			   &w->target, entry))
		return false;
	return !write || w->target.means == MEANS_NEW || w->target.write ||
	       entry_wrong(entry, N_("this cannot be written"), text, len);
}

static bool look_up_all(const struct entry_place *place, struct work *w,
			struct entry *entry)
{
	const struct expr *expr = &w->expr;

	entry_infer(place, expr, type_of, w, &w->types);
	if (expr->target && expr->target_index < 0 &&
	    !look_up(place, expr->target, expr->target_len,
		     (enum iec_type)w->types.target, true, w, entry))
		return false;
	for (int i = 0; i < expr->count; i++)
		if (expr->node[i].op == EXPR_NAME &&
		    !look_up(place, expr->node[i].text, expr->node[i].len,
			     (enum iec_type)w->types.wanted[i], false, w, entry))
			return false;
	return true;
}

/* Parsed from the text that is kept, so that it will read again. */
static bool read_expression(const struct entry_place *place, struct work *w,
			    struct entry *entry)
{
	diag_init(&w->diags);
	if (!expr_parse_text(entry->operand, strlen(entry->operand), &w->expr, &w->diags,
			     (struct diag){ .id = DIAG_BAD_EXPRESSION }))
		return entry_wrong(entry, N_("this is no expression"), entry->operand,
				   strlen(entry->operand));
	entry->word = w->expr.target ? ELEM_ASSIGN : ELEM_COMPARE;
	if (place->output && !w->expr.target)
		return entry_wrong(entry, N_("only an output can stand in the last column"),
				   entry->operand, strlen(entry->operand));
	if (!look_up_all(place, w, entry))
		return false;
	entry->sense = ENTRY_ELEMENT;
	return true;
}

bool entry_expression(const struct entry_place *place, const char *text, size_t len,
		      struct entry *entry)
{
	struct work *w;
	bool good;

	w = calloc(1, sizeof(*w));
	if (!w)
		return entry_wrong(entry, N_("out of memory"), "", 0);
	good = print(text, len, w, entry) && read_expression(place, w, entry);
	free(w);
	return good;
}

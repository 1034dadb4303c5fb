/* SPDX-License-Identifier: MIT
 *
 * entry_expression - a comparison or an assignment, typed with or without brackets.
 *
 * The engine parses it; here its names are looked up, and the new ones given a type.
 */
#include "editor-gtk/entry_inside.h"
#include "editor-gtk/i18n.h"

#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/model/expr.h"

#include <stdlib.h>
#include <string.h>

/* What does not fit a small stack. */
struct work {
	struct expr expr;
	struct diag_list diags;
	struct entry_target target;
};

/* With one blank round := and comparisons, one where there were some, else none. */
static bool print(const char *text, size_t len, char *out, size_t size)
{
	static const char *const wide[] = { ":=", "<", ">", "<=", ">=", "=", "<>" };
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
	}
	return good;
}

/* What the names that are not declared yet will be: as the others are, or the
 * constants. */
static const char *common_type(const struct entry_place *place, const struct expr *expr,
			       struct entry_target *target)
{
	const char *type = "INT";

	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *node = &expr->node[i];
		struct literal literal;

		if (node->op == EXPR_NAME) {
			entry_target_find(place, node->text, node->len, target);
			if (target->means == MEANS_VALUE)
				return iec_type_row(target->type)->word;
		} else if (node->op == EXPR_LITERAL &&
			   literal_parse(node->text, node->len, &literal) == LITERAL_OK) {
			if (literal.type != IEC_NONE)
				type = iec_type_row(literal.type)->word;
			else if (literal.real)
				type = "REAL";
		}
	}
	return type;
}

static bool look_up(const struct entry_place *place, const char *text, size_t len,
		    const char *type, bool write, struct work *w, struct entry *entry)
{
	entry_target_find(place, text, len, &w->target);
	switch (w->target.means) {
	case MEANS_NOTHING:
	case MEANS_WRONG:
		return entry_wrong(entry, w->target.why ? w->target.why :
				   N_("this is no value"), text, len);
	case MEANS_NEW:
		return entry_declare(place, entry, text, len, type, "");
	case MEANS_VALUE:
	case MEANS_INSTANCE:
		break;
	}
	return !write || w->target.write ||
	       entry_wrong(entry, N_("this cannot be written"), text, len);
}

static bool look_up_all(const struct entry_place *place, struct work *w,
			struct entry *entry)
{
	const struct expr *expr = &w->expr;
	const char *type = common_type(place, expr, &w->target);

	if (expr->target && expr->target_index < 0 &&
	    !look_up(place, expr->target, expr->target_len, type, true, w, entry))
		return false;
	for (int i = 0; i < expr->count; i++)
		if (expr->node[i].op == EXPR_NAME &&
		    !look_up(place, expr->node[i].text, expr->node[i].len, type, false,
			     w, entry))
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

	if (!print(text, len, entry->operand, sizeof(entry->operand)))
		return entry_wrong(entry, N_("this line is too long"), "", 0);
	w = calloc(1, sizeof(*w));
	if (!w)
		return entry_wrong(entry, N_("out of memory"), "", 0);
	good = read_expression(place, w, entry);
	free(w);
	return good;
}

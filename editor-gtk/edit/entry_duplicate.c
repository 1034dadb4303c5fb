/* SPDX-License-Identifier: MIT
 *
 * entry_duplicate - copies of rungs with instances of their own; see entry_duplicate.h.
 *
 * An instance gets its new name wherever the rungs name it: in the box, in a contact of its
 * output, in parameters and expressions. The caller declares the new instances.
 */
#include "editor-gtk/edit/entry_duplicate.h"
#include "editor-gtk/edit/entry_operand.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/name.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The name without the number at its end. */
static void base_of(const char *name, char *out, size_t size)
{
	size_t len = strlen(name);

	while (len > 1 && ascii_digit(name[len - 1]))
		len--;
	snprintf(out, size, "%.*s", (int)len, name);
}

static bool is_new(const struct project *project, const struct entry_instance *made,
		   int count, const char *name)
{
	for (int i = 0; i < count; i++)
		if (name_equal(project_text(project, made[i].to), name))
			return false;
	return true;
}

/* Adds a new instance for @one.from to @made. False: no memory. */
static bool add(const struct entry_place *place, struct entry_instance one,
		struct entry_instance *made, int *count)
{
	struct names *names = &place->project->names;
	char base[LIMIT_NAME + 1], name[ENTRY_NAME];
	int number = 1;

	base_of(project_text(place->project, one.from), base, sizeof(base));
	do
		snprintf(name, sizeof(name), "%.*s%d", LIMIT_NAME - 12, base, number++);
	while (number < LIMIT_VARS && (entry_name_taken(place, NULL, name) ||
				       !is_new(place->project, made, *count, name)));
	one.to = names_intern(names, name, strlen(name));
	made[(*count)++] = one;
	return one.to != 0;
}

/* The variable of a box, if it may be renamed; else NULL. */
static const struct var *instance_of(const struct entry_place *place,
				     const struct cell *cell, bool *retain)
{
	const struct word_row *row = words_row(&place->project->words,
					       (enum word)cell->word);
	const char *name = project_text(place->project, cell->operand);
	const struct var *var;
	uint16_t flags = 0;

	if (row->kind != WORD_FB || !entry_is_name(name, strlen(name)))
		return NULL;
	var = entry_var_find(place, name, strlen(name), &flags);
	*retain = flags & VAR_RETAIN;
	return var && var->type == IEC_NONE && var->array.count == 0 &&
	       !(flags & (VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT)) ? var : NULL;
}

static const struct entry_instance *find(const struct project *project,
					 const struct entry_instance *made, int count,
					 const char *name, size_t len)
{
	for (int i = 0; i < count; i++)
		if (name_is(project_text(project, made[i].from), name, len))
			return &made[i];
	return NULL;
}

/* Bytes of the name before its first dot; 0: the token is no name. */
static size_t head_of(const struct token *token)
{
	const char *dot = memchr(token->text, '.', token->len);

	if (token->kind != TOKEN_NAME)
		return 0;
	return dot ? (size_t)(dot - token->text) : token->len;
}

/* Moves to the next name of an instance outside quotes; NULL: none follows. */
static const struct entry_instance *next(const struct project *project, struct lex *lex,
					 const struct entry_instance *made, int count)
{
	bool quoted = false;

	while (lex_next(lex) != TOKEN_END) {
		const size_t head = head_of(&lex->token);
		const struct entry_instance *one = head > 0 && !quoted ?
			find(project, made, count, lex->token.text, head) : NULL;

		quoted ^= *lex->token.text == '\'';
		if (one)
			return one;
	}
	return NULL;
}

/* False: no memory. */
static bool rename_text(struct project *project, uint32_t *id,
			const struct entry_instance *made, int count)
{
	const char *from = project_text(project, *id), *done = from;
	const struct entry_instance *one;
	size_t size = strlen(from) + 1;
	struct lex lex;
	char *out;

	lex_init(&lex, from, strlen(from));
	while (next(project, &lex, made, count))
		size += LIMIT_NAME;
	if (size == strlen(from) + 1)
		return true;
	out = calloc(1, size);
	if (!out)
		return false;
	lex_init(&lex, from, strlen(from));
	while ((one = next(project, &lex, made, count)) != NULL) {
		const char *to = project_text(project, one->to);

		entry_append(out, size, done, (size_t)(lex.token.text - done));
		entry_append(out, size, to, strlen(to));
		done = lex.token.text + head_of(&lex.token);
	}
	entry_append(out, size, done, strlen(done));
	*id = names_intern(&project->names, out, strlen(out));
	free(out);
	return *id != 0;
}

static bool find_all(const struct entry_place *place, const struct rung *rung,
		     struct entry_instance *made, int *count)
{
	bool good = true;

	for (int i = 0; good && i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];
		bool retain = false;
		const struct var *var = instance_of(place, cell, &retain);
		const char *name = var ? project_text(place->project, var->name) : "";

		if (var && !find(place->project, made, *count, name, strlen(name)))
			good = add(place, (struct entry_instance){ .from = var->name,
				   .word = (enum word)cell->word, .retain = retain },
				   made, count);
	}
	return good;
}

/* NULL: no memory. */
static struct rung *copy_of(struct project *project, const struct rung *rung,
			    const struct entry_instance *made, int count)
{
	struct rung *copy = rung_copy(rung);
	bool good = copy != NULL;

	for (int i = 0; good && i < copy->rows * copy->cols; i++)
		good = rename_text(project, &copy->cell[i].operand, made, count) &&
		       rename_text(project, &copy->cell[i].args, made, count);
	if (good)
		return copy;
	rung_free(copy);
	return NULL;
}

static size_t cells_of(struct rung *const *rungs, int count)
{
	size_t cells = 1;

	for (int i = 0; i < count; i++)
		cells += (size_t)(rungs[i]->rows * rungs[i]->cols);
	return cells;
}

bool entry_duplicate(const struct entry_place *place, struct rung **rungs, int count,
		     struct entry_instance **made, int *made_count)
{
	struct rung **copy = calloc((size_t)count, sizeof(struct rung *));
	bool good;

	*made_count = 0;
	*made = calloc(cells_of(rungs, count), sizeof(**made));
	good = copy && *made;
	for (int i = 0; good && i < count; i++)
		good = find_all(place, rungs[i], *made, made_count);
	for (int i = 0; good && i < count; i++)
		good = (copy[i] = copy_of(place->project, rungs[i], *made,
					  *made_count)) != NULL;
	for (int i = 0; copy && i < count; i++) {
		if (good)
			rungs[i] = copy[i];
		else
			rung_free(copy[i]);
	}
	free(copy);
	if (good)
		return true;
	free(*made);
	*made = NULL;
	return false;
}

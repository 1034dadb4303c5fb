/* SPDX-License-Identifier: MIT
 *
 * caller - the program of a text that has a function main and no program; see caller.h.
 */
#include "engine/model/caller.h"

#include "engine/base/name.h"
#include "engine/model/st.h"

#include <stdio.h>
#include <string.h>

/* Does the function call a program? */
static bool calls_program(struct project *project, const struct pou *function)
{
	for (int i = 0; function->st && i < function->st->count; i++) {
		const struct st_item *item = &function->st->item[i];
		const char *text = project_text(project, item->text);
		int pou;

		if (item->kind != ST_CALL)
			continue;
		pou = project_find_pou(project, text, strcspn(text, "(. \t\r\n"));
		if (pou >= 0 && project->pou[pou].kind == POU_PROGRAM)
			return true;
	}
	return false;
}

/* The function that runs in each scan: it is called main and needs no argument; there is no
 * program, or it calls one. -1: none. */
static int find_main(struct project *project)
{
	int found = -1;
	bool programs = false;

	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];

		if (project->config)
			return -1;
		programs |= pou->kind == POU_PROGRAM;
		if (pou->kind == POU_FUNCTION && name_is("main", project_text(project, pou->name),
							 names_len(&project->names, pou->name)))
			found = i;
	}
	for (int i = 0; found >= 0 && i < project->pou[found].vars.count; i++)
		if (vars_flags(&project->pou[found].vars, i) & (VAR_INPUT | VAR_IN_OUT))
			return -1;
	if (programs && found >= 0 && !calls_program(project, &project->pou[found]))
		return -1;
	return found;
}

/* The program of its call: main := main(); The variable has the name of the function. */
static bool make_caller(struct project *project, const struct pou *function, struct pou *out)
{
	const char *name = project_text(project, function->name);
	char text[2 * LIMIT_NAME + 16];
	const int len = function->no_result ? snprintf(text, sizeof(text), "%s()", name) :
					      snprintf(text, sizeof(text), "%s := %s()", name, name);
	struct var_block *block = arena_alloc(&project->arena, sizeof(*block));
	struct var *result = arena_alloc(&project->arena, sizeof(*result));
	struct st_item *item = arena_alloc(&project->arena, sizeof(*item));
	struct st *st = arena_alloc(&project->arena, sizeof(*st));

	if (!block || !result || !item || !st)
		return false;
	*result = function->vars.var[0];
	*block = (struct var_block){ .flags = VAR_OUTPUT, .count = 1, .line = function->line };
	*item = (struct st_item){ .kind = function->no_result ? ST_CALL : ST_ASSIGN,
				  .text = names_intern(&project->names, text, (size_t)len),
				  .line = function->line, .column = 1 };
	*st = (struct st){ item, 1 };
	*out = (struct pou){ .name = names_intern(&project->names, "_main", 5), .kind = POU_PROGRAM,
			     .language = LANGUAGE_ST, .word = WORD_COUNT, .temp_word = WORD_COUNT,
			     .st = st, .file = function->file, .line = function->line };
	out->il.arena = &project->arena;
	if (!function->no_result)
		out->vars = (struct var_table){ .var = result, .count = 1, .block = block, .block_count = 1 };
	return out->name && item->text;
}

bool caller_add(struct project *project)
{
	const int at = project->pou_count, main = find_main(project);
	struct pou *pou;
	int room = 8;

	if (main < 0)
		return true;
	while (room < at + 1)
		room *= 2;
	pou = arena_alloc(&project->arena, 2 * (size_t)room * sizeof(*pou));
	if (!pou)
		return false;
	memcpy(pou, project->pou, (size_t)at * sizeof(*pou));
	project->pou = pou;
	project->pou_count++;
	return make_caller(project, &pou[main], &pou[at]);
}

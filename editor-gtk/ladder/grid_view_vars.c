/* SPDX-License-Identifier: MIT
 *
 * grid_view_vars - the variables of an element, by the names that charts know them by.
 *
 * What is dragged into a chart is text, so that anything that takes a name may have it.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include <string.h>

static bool is_word(char c)
{
	return g_ascii_isalnum(c) || c == '_' || c & 0x80;
}

/* A name with its members and constant indices, or an address; 0: something else. */
static gsize name_length(const char *text)
{
	gsize len = *text == '%';

	if (!len && (!is_word(*text) || g_ascii_isdigit(*text)))
		return 0;
	while (is_word(text[len]) || (text[len] == '.' && is_word(text[len + 1])))
		len++;
	while (text[len] == '[') {
		const gsize index = strspn(text + len + 1, "-0123456789,");

		if (text[len + 1 + index] != ']')
			break;
		len += index + 2;
		while (is_word(text[len]) || text[len] == '.')
			len++;
	}
	return len;
}

static bool is_declared(const struct project *project, const struct var_table *vars,
			const char *name)
{
	const gsize len = strcspn(name, ".[");

	for (int i = 0; i < vars->count; i++) {
		const char *own = project_text(project, vars->var[i].name);

		if (strlen(own) == len && g_ascii_strncasecmp(own, name, len) == 0)
			return true;
	}
	return false;
}

/* "Main.Count" of Count; NULL: it is no variable, or stands nowhere by itself. */
static char *full_name(LadderGridView *view, const char *name)
{
	const struct project *project = ladder_document_project(view->document);
	const struct pou *pou = sheet_pou(view);
	const char *owner = pou->kind == POU_PROGRAM || pou->kind == POU_SUBROUTINE ?
		project_text(project, pou->name) : ladder_grid_view_instance(view);

	if (*name == '%')
		return g_strdup(name);
	if (is_declared(project, &pou->vars, name))
		return owner ? g_strconcat(owner, ".", name, NULL) : NULL;
	return is_declared(project, &project->globals, name) ? g_strdup(name) : NULL;
}

/* Of an argument `IN1:=Count` the name of the pin is none. */
static bool is_pin(const char *behind)
{
	behind += strspn(behind, " ");
	return g_str_has_prefix(behind, ":=") || g_str_has_prefix(behind, "=>");
}

static void take_names(LadderGridView *view, const char *text, bool args, GPtrArray *names)
{
	while (*text) {
		const gsize len = name_length(text);
		char *name = len ? g_strndup(text, len) : NULL;
		char *full = name && !(args && is_pin(text + len)) ? full_name(view, name) :
								     NULL;

		if (full && !g_ptr_array_find_with_equal_func(names, full, g_str_equal, NULL))
			g_ptr_array_add(names, g_steal_pointer(&full));
		g_free(full);
		g_free(name);
		/* Letters behind a number are no name. */
		text += len ? len : MAX(strspn(text, "0123456789#_."), 1);
	}
}

char *sheet_variables(LadderGridView *view, const struct cell *cell)
{
	const struct project *project = ladder_document_project(view->document);
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	char *all;

	take_names(view, project_text(project, cell->operand), false, names);
	if (names->len == 0 && cell->args)
		take_names(view, project_text(project, cell->args), true, names);
	g_ptr_array_add(names, NULL);
	all = g_strjoinv(" ", (char **)names->pdata);
	g_ptr_array_unref(names);
	return all;
}

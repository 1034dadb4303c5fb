/* SPDX-License-Identifier: MIT
 *
 * help - see help.h.
 */
#include "editor-gtk/window/help.h"

#include "editor-gtk/document/manual.h"
#include "editor-gtk/edit/sfc_lines.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/manual_window.h"
#include "editor-gtk/panels/problems.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/front.h"
#include "editor-gtk/window/messages.h"

#include <string.h>

#define PAGE "editor.md" /* where there is nothing better                       */

const struct help_place *help_place(int index)
{
	static const struct help_place places[] = {
#define PLACE(name, page, anchor) { name, page, anchor },
#include "editor-gtk/window/help_places.def"
	};

	return index < (int)G_N_ELEMENTS(places) ? &places[index] : NULL;
}

/* ---- the window of the manual ---- */

static void tell_nothing_opens(struct help *help, const char *path)
{
	char *text = g_strdup_printf(_("The manual is in “%s”, but no program here opens such "
		"pages. Install a viewer for Markdown files, or an editor that was built with "
		"md4c."), path);

	messages_warn(help->core->messages, text);
	g_free(text);
}

#define OPENED "manual-path" /* data of a window: what it wanted to open         */

/* The window may be closed meanwhile: it has no help then. */
static void opened(GObject *window, GAsyncResult *result, gpointer unused)
{
	struct help *help = g_object_get_data(window, "help");

	(void)unused;
	if (!gtk_show_uri_full_finish(GTK_WINDOW(window), result, NULL) && help)
		tell_nothing_opens(help, g_object_get_data(window, OPENED));
}

/* Without the library for the pages: the program for such files. */
static LadderManualWindow *show_outside(struct help *help, struct manual *manual,
					const char *page)
{
	GObject *window = G_OBJECT(help->core->window);
	char *path = g_build_filename(manual_folder(manual), page, NULL);
	char *uri = g_filename_to_uri(path, NULL, NULL);

	g_object_set_data(window, "help", help);
	g_object_set_data_full(window, OPENED, path, g_free);
	if (uri)
		gtk_show_uri_full(GTK_WINDOW(window), uri, GDK_CURRENT_TIME, NULL, opened, NULL);
	g_free(uri);
	manual_free(manual);
	return NULL;
}

/* NULL, and nothing else is to be done: the window says that there is no manual, or another
 * program shows @page. */
static LadderManualWindow *window_of(struct help *help, const char *page)
{
	struct manual *manual;

	if (help->window)
		return LADDER_MANUAL_WINDOW(help->window);
	manual = manual_new();
	if (!manual) {
		messages_warn(help->core->messages, _("The manual is not installed."));
		return NULL;
	}
	if (!markdown_is_here())
		return show_outside(help, manual, page ? page : PAGE);
	help->window = GTK_WINDOW(ladder_manual_window_new(manual));
	g_object_add_weak_pointer(G_OBJECT(help->window), (gpointer *)&help->window);
	gtk_window_set_application(help->window,
				   gtk_window_get_application(help->core->window));
	ladder_manual_window_show(LADDER_MANUAL_WINDOW(help->window),
		manual_find(manual, page ? page : PAGE), -1);
	return LADDER_MANUAL_WINDOW(help->window);
}

static void show(struct help *help, const char *page, const char *anchor)
{
	LadderManualWindow *window = window_of(help, page);
	struct manual *manual = window ? ladder_manual_window_manual(window) : NULL;
	const int at = window && page ? manual_find(manual, page) : -1;

	if (!window)
		return;
	if (at >= 0)
		ladder_manual_window_show(window, at, *anchor ?
					  manual_anchor(manual, at, anchor) : -1);
	gtk_window_present(help->window);
}

void help_show(struct help *help, const char *page)
{
	show(help, page, "");
}

/* ---- F1 ---- */

static void show_place(struct help *help, const char *name)
{
	const struct help_place *place = help_place(0);

	for (int i = 0; (place = help_place(i)) && strcmp(place->name, name) != 0;)
		i++;
	if (place)
		show(help, place->page, place->anchor);
	else
		show(help, PAGE, "");
}

/* False: the manual has no entry for the word. */
static bool show_word(struct help *help, const char *word)
{
	LadderManualWindow *window;
	struct manual *manual;
	int block;

	if (!*word)
		return false;
	window = window_of(help, "words.md");
	if (!window)
		return true;
	manual = ladder_manual_window_manual(window);
	block = manual_word(manual, word);
	if (block < 0)
		return false;
	ladder_manual_window_show(window, manual_find(manual, "words.md"), block);
	gtk_window_present(help->window);
	return true;
}

static void show_element(struct help *help, LadderGridView *sheet)
{
	const struct project *project = ladder_document_project(help->core->document);
	const int pou = ladder_canvas_pou(LADDER_CANVAS(sheet));
	const int rung = ladder_grid_view_first(sheet) + ladder_grid_view_cursor(sheet).rung;
	const struct cell *cell;
	int row, col;

	if (!project || pou >= project->pou_count || rung >= project->pou[pou].rung_count ||
	    !ladder_grid_view_cell(sheet, &row, &col)) {
		show_place(help, "sheet");
		return;
	}
	cell = rung_at(project->pou[pou].rung[rung], row, col);
	if (word_is_own(cell->word))
		show_place(help, "own block");
	else if (!show_word(help, words_row(&project->words, cell->word)->word))
		show_place(help, "sheet");
}

static void show_chart(struct help *help, LadderSfcView *chart)
{
	const struct project *project = ladder_document_project(help->core->document);
	const int pou = ladder_canvas_pou(LADDER_CANVAS(chart));
	const int row = ladder_sfc_view_row(chart);

	if (!project || row < 0 || pou >= project->pou_count || !project->pou[pou].sfc) {
		show_place(help, "chart");
		return;
	}
	switch (sfc_spot_at(project, project->pou[pou].sfc, project->pou[pou].line + row).kind) {
	case SPOT_STEP: show_place(help, "step"); break;
	case SPOT_TRANSITION: show_place(help, "transition"); break;
	case SPOT_USE: case SPOT_ACTION: show_place(help, "action"); break;
	case SPOT_CONTROL: case SPOT_NONE: show_place(help, "chart"); break;
	}
}

static void show_networks(struct help *help, LadderFbdView *networks)
{
	const char *word = ladder_fbd_view_word(networks);

	if (!word || !show_word(help, word))
		show_place(help, "networks");
}

/* The word that the text cursor is in or behind. Caller frees. */
static char *word_at(GtkTextBuffer *buffer)
{
	GtkTextIter from, to;

	gtk_text_buffer_get_iter_at_mark(buffer, &from, gtk_text_buffer_get_insert(buffer));
	to = from;
	while (gtk_text_iter_backward_char(&from))
		if (!g_unichar_isalnum(gtk_text_iter_get_char(&from)) &&
		    gtk_text_iter_get_char(&from) != '_') {
			gtk_text_iter_forward_char(&from);
			break;
		}
	while (g_unichar_isalnum(gtk_text_iter_get_char(&to)) ||
	       gtk_text_iter_get_char(&to) == '_')
		gtk_text_iter_forward_char(&to);
	return gtk_text_buffer_get_text(buffer, &from, &to, FALSE);
}

static void show_text(struct help *help, GtkTextBuffer *buffer, const char *place)
{
	char *word = word_at(buffer), *upper = g_utf8_strup(word, -1);

	if (!show_word(help, upper))
		show_place(help, place);
	g_free(upper);
	g_free(word);
}

static void show_problem(struct help *help)
{
	GtkWidget *problems = below_made(help->core->below, "problems");
	const char *code = problems ? ladder_problems_code(LADDER_PROBLEMS(problems)) : "";
	LadderManualWindow *window = *code ? window_of(help, PAGE) : NULL;
	int page, block;

	if (window && manual_code(ladder_manual_window_manual(window), code, &page, &block)) {
		ladder_manual_window_show(window, page, block);
		gtk_window_present(help->window);
	} else if (window || !*code) {
		show_place(help, "below problems");
	}
}

static bool is_inside(GtkWidget *widget, const char *type)
{
	for (; widget; widget = gtk_widget_get_parent(widget))
		if (strcmp(G_OBJECT_TYPE_NAME(widget), type) == 0)
			return true;
	return false;
}

/* A place beside the pages; NULL: the focus is in none. */
static const char *beside(struct help *help, GtkWidget *focus)
{
	static const char *const widgets[][2] = {
		{ "LadderPalette", "palette" }, { "LadderSimPanel", "simulation" },
		{ "LadderFindBar", "find" },
	};

	if (gtk_widget_is_ancestor(focus, help->core->tree))
		return "tree";
	for (gsize i = 0; i < G_N_ELEMENTS(widgets); i++)
		if (is_inside(focus, widgets[i][0]))
			return widgets[i][1];
	return NULL;
}

static void show_file(struct help *help, LadderSideFile *file)
{
	char *name = ladder_side_file_name(file);

	show_place(help, g_str_has_suffix(name, ".io") ? "I/O map" : "scenario");
	g_free(name);
}

static void show_front(struct help *help)
{
	struct front *front = help->core->front;
	AdwTabPage *page = front_tab(front);
	char *place;

	if (front_seen_sheet(front)) {
		show_element(help, front_seen_sheet(front));
	} else if (front_seen_networks(front)) {
		show_networks(help, front_seen_networks(front));
	} else if (front_seen_chart(front)) {
		show_chart(help, front_seen_chart(front));
	} else if (front_list(front)) {
		show_text(help, page_text(page), "list");
	} else if (front_file(front)) {
		show_file(help, front_file(front));
	} else if (page) {
		place = g_strdup_printf("page%s", page_name(page));
		show_place(help, place);
		g_free(place);
	} else {
		show_place(help, "");
	}
}

void help_here(struct help *help)
{
	GtkWidget *focus = gtk_window_get_focus(help->core->window);
	const char *place = focus ? beside(help, focus) : NULL;
	GtkStack *below = help->core->below->stack;
	char *name;

	if (place) {
		show_place(help, place);
	} else if (focus && gtk_widget_is_ancestor(focus, GTK_WIDGET(help->core->below->box))) {
		name = g_strdup_printf("below %s", gtk_stack_get_visible_child_name(below));
		if (strcmp(name, "below problems") == 0)
			show_problem(help);
		else
			show_place(help, name);
		g_free(name);
	} else {
		show_front(help);
	}
}

void help_init(struct help *help, struct core *core)
{
	*help = (struct help){ .core = core };
}

void help_clear(struct help *help)
{
	GtkWindow *window = help->window;

	g_object_set_data(G_OBJECT(help->core->window), "help", NULL);
	if (window)
		g_object_remove_weak_pointer(G_OBJECT(window), (gpointer *)&help->window);
	help->window = NULL;
	if (window)
		gtk_window_destroy(window);
}

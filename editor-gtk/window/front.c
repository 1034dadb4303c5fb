/* SPDX-License-Identifier: MIT
 *
 * front - the part of the program that is visible; see front.h.
 */
#include "editor-gtk/window/front.h"

#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/drop.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/text_scroll.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/left.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/messages.h"

#include <string.h>

/* ---- what is seen ---- */

bool front_is_older(const struct front *front)
{
	return front->older && front->page;
}

AdwTabPage *front_tab(struct front *front)
{
	return adw_tab_view_get_selected_page(front->tabs);
}

/* The visible page, including its scrolled window; NULL: none. */
static GtkWidget *seen_page(struct front *front)
{
	AdwTabPage *tab = front_tab(front);

	if (front_is_older(front))
		return front->page;
	return tab ? adw_tab_page_get_child(tab) : NULL;
}

static GtkWidget *seen(struct front *front)
{
	GtkWidget *page = seen_page(front), *content = page ? page_inside(page) : NULL;

	if (!LADDER_IS_SHOWN_PAGE(content))
		return content;
	page = ladder_shown_page_child(LADDER_SHOWN_PAGE(content));
	return page ? page_inside(page) : NULL;
}

/* Does the visible sheet belong to another document than that of the window? */
static bool is_other(struct front *front)
{
	GtkWidget *content = page_content(front_tab(front));

	return front_is_older(front) || LADDER_IS_SHOWN_PAGE(content);
}

int front_pou(struct front *front)
{
	const struct project *project = ladder_document_project(front->core->document);
	AdwTabPage *tab = front_is_older(front) ? NULL : front_tab(front);
	GtkWidget *content = page_content(tab);
	const char *name = tab ? page_name(tab) : NULL;

	if (LADDER_IS_SHOWN_PAGE(content))
		return ladder_shown_page_pou(LADDER_SHOWN_PAGE(content));
	return project && name && name[0] != ' ' ? project_find_pou(project, name, strlen(name)) : -1;
}

/* The text below a ladder, if it has the focus, or had it last; NULL: the sheet. */
static LadderTextView *text_below(GtkWidget *content)
{
	LadderRungPage *page = LADDER_IS_GRID_VIEW(content) ? ladder_rung_page_of(content) : NULL;

	return page ? ladder_rung_page_text(page) : NULL;
}

LadderGridView *front_seen_sheet(struct front *front)
{
	GtkWidget *content = seen(front);

	if (LADDER_IS_SFC_PAGE(content))
		return ladder_sfc_page_sheet(LADDER_SFC_PAGE(content));
	return LADDER_IS_GRID_VIEW(content) && !text_below(content) ? LADDER_GRID_VIEW(content) : NULL;
}

LadderSfcView *front_seen_chart(struct front *front)
{
	GtkWidget *content = seen(front);

	return LADDER_IS_SFC_PAGE(content) ?
	       ladder_sfc_page_chart(LADDER_SFC_PAGE(content)) : NULL;
}

LadderFbdView *front_seen_networks(struct front *front)
{
	GtkWidget *content = seen(front);

	return LADDER_IS_FBD_VIEW(content) ? LADDER_FBD_VIEW(content) : NULL;
}

LadderCanvas *front_seen_canvas(struct front *front)
{
	LadderGridView *sheet = front_seen_sheet(front);
	LadderFbdView *networks = front_seen_networks(front);

	if (networks)
		return LADDER_CANVAS(networks);
	return sheet ? LADDER_CANVAS(sheet) : LADDER_CANVAS(front_seen_chart(front));
}

LadderGridView *front_sheet(struct front *front)
{
	return is_other(front) ? NULL : front_seen_sheet(front);
}

LadderSfcView *front_chart(struct front *front)
{
	return is_other(front) ? NULL : front_seen_chart(front);
}

LadderFbdView *front_networks(struct front *front)
{
	return is_other(front) ? NULL : front_seen_networks(front);
}

LadderGridView *front_rungs(struct front *front)
{
	GtkWidget *content = page_content(front_tab(front));

	return LADDER_IS_SFC_PAGE(content) && !front_is_older(front) ?
	       ladder_sfc_page_rungs(LADDER_SFC_PAGE(content)) : front_sheet(front);
}

LadderTextView *front_list(struct front *front)
{
	GtkWidget *content = page_content(front_tab(front));

	if (LADDER_IS_SFC_PAGE(content))
		return ladder_sfc_page_text(LADDER_SFC_PAGE(content));
	if (text_below(content))
		return text_below(content);
	return LADDER_IS_TEXT_VIEW(content) &&
	       ladder_text_view_pou(LADDER_TEXT_VIEW(content)) >= 0 ?
	       LADDER_TEXT_VIEW(content) : NULL;
}

LadderSideFile *front_file(struct front *front)
{
	return page_file(front_tab(front));
}

/* ---- the keys ---- */

bool front_enter_program(struct front *front)
{
	LadderCanvas *canvas = front_seen_canvas(front);
	GtkWidget *content = seen(front);

	if (canvas)
		gtk_widget_grab_focus(GTK_WIDGET(canvas));
	else if (LADDER_IS_TEXT_VIEW(content))
		gtk_widget_grab_focus(content);
	else if (text_below(content))
		gtk_widget_grab_focus(GTK_WIDGET(text_below(content)));
	else
		return front_tab(front) && LADDER_IS_SHOWN_PAGE(page_content(front_tab(front))) &&
		       ladder_shown_page_enter(LADDER_SHOWN_PAGE(page_content(front_tab(front))));
	return true;
}

static bool has_focus(struct front *front, GtkWidget *widget)
{
	GtkWidget *focus = gtk_window_get_focus(front->core->window);

	return focus && gtk_widget_is_ancestor(focus, widget);
}

void front_enter(struct front *front)
{
	GtkWidget *page = seen_page(front);

	/* A cell that is being edited keeps the focus. */
	if (page && !has_focus(front, page) && !front_enter_program(front))
		gtk_widget_child_focus(page, GTK_DIR_TAB_FORWARD);
}

bool front_take_typed(struct front *front)
{
	GtkWidget *focus, *text;

	left_now();
	focus = gtk_window_get_focus(front->core->window);
	text = focus ? gtk_widget_get_ancestor(focus, LADDER_TYPE_TEXT_VIEW) : NULL;
	if (text)
		ladder_text_view_take(LADDER_TEXT_VIEW(text));
	return cells_take(front->core->window);
}

/* ---- a program before an edit ---- */

static void tell_place(struct front *front)
{
	g_signal_emit_by_name(front->core->window, "place-changed");
}

static void drop_page(struct front *front)
{
	if (front->page)
		gtk_box_remove(GTK_BOX(front->box), front->page);
	front->page = NULL;
}

static void show_pou(struct front *front, int pou)
{
	drop_page(front);
	front->page = page_new(front->core, front->older, pou);
	gtk_widget_set_vexpand(front->page, TRUE);
	gtk_box_append(GTK_BOX(front->box), front->page);
	tell_place(front);
}

static void chosen(struct front *front)
{
	const guint pou = gtk_drop_down_get_selected(front->pous);

	if (!front->filling && front->older && pou != GTK_INVALID_LIST_POSITION)
		show_pou(front, (int)pou);
}

bool front_older_by(struct front *front, int by)
{
	int count, next;

	if (!front_is_older(front))
		return false;
	count = (int)g_list_model_get_n_items(gtk_drop_down_get_model(front->pous));
	next = ((int)gtk_drop_down_get_selected(front->pous) + by + count) % count;
	gtk_drop_down_set_selected(front->pous, (guint)next);
	return true;
}

/* The POU in front if the older program has it, else the first. */
static int pou_before(struct front *front, const struct project *project)
{
	const struct project *now = ladder_document_project(front->core->document);
	const int pou = front_pou(front);
	const char *name = now && pou >= 0 && pou < now->pou_count ? project_text(now, now->pou[pou].name) : "";

	return MAX(project_find_pou(project, name, strlen(name)), 0);
}

static void fill_pous(struct front *front)
{
	const struct project *project = ladder_document_project(front->older);
	GPtrArray *names = g_ptr_array_new();
	const int pou = project ? pou_before(front, project) : 0;

	for (int i = 0; project && i < project->pou_count; i++)
		g_ptr_array_add(names, (gpointer)project_text(project, project->pou[i].name));
	front->filling = true;
	drop_fill(front->pous, names);
	gtk_drop_down_set_selected(front->pous, (guint)pou);
	front->filling = false;
	gtk_widget_set_visible(GTK_WIDGET(front->pous), names->len > 1);
	g_ptr_array_unref(names);
	show_pou(front, pou);
}

/* ---- coming and going ---- */

static void see(struct front *front, bool older)
{
	gtk_widget_set_visible(front->box, older);
	gtk_widget_set_visible(front->now, !older);
	gtk_widget_set_visible(GTK_WIDGET(front->tab_bar), !older);
}

static void say_which(struct front *front, const struct sim_edited *edit)
{
	GDateTime *when = g_date_time_new_from_unix_local(edit->us / G_USEC_PER_SEC);
	char *clock = g_date_time_format(when, "%H:%M:%S");
	char *text = g_strdup_printf(_("The program before the edit at %s, after scan %llu "
				       "(read-only)"), clock,
				     (unsigned long long)edit->scan);

	gtk_label_set_text(front->label, text);
	g_free(text);
	g_free(clock);
	g_date_time_unref(when);
}

static void leave(struct front *front)
{
	const bool focus = has_focus(front, front->box);

	drop_page(front);
	g_clear_object(&front->older);
	see(front, false);
	if (focus)
		front_enter_program(front);
	tell_place(front);
}

static void enter(struct front *front, LadderDocument *document,
		  const struct sim_edited *edit)
{
	const bool focus = has_focus(front, GTK_WIDGET(front->tabs)) ||
			   has_focus(front, front->box);

	g_set_object(&front->older, document);
	say_which(front, edit);
	fill_pous(front);
	see(front, true);
	if (focus)
		front_enter_program(front);
}

static void program_changed(struct front *front)
{
	struct sim_edited edit;
	LadderDocument *document = ladder_sim_older(front->core->sim, &edit);
	const struct project *project = document ? ladder_document_project(document) : NULL;

	if (project && project->pou_count > 0)
		enter(front, document, &edit);
	else if (front->older)
		leave(front);
}

/* ---- going to a number ---- */

/* The range of numbers to go to: rungs as they are shown, networks, or lines, from 1. */
struct numbers {
	LadderGridView *sheet;
	LadderFbdView *networks;
	GtkTextBuffer *text;
	int first, last;       /* 1 and 0: nothing to go to                    */
};

static struct numbers numbers_of(struct front *front)
{
	struct numbers of = { front_seen_sheet(front), front_seen_networks(front),
			      page_text(front_tab(front)), 1, 0 };
	const struct project *project;

	if (of.sheet) {
		project = ladder_document_project(ladder_canvas_document(LADDER_CANVAS(of.sheet)));
		of.first = 1 + ladder_grid_view_range(of.sheet, &of.last);
		of.last = of.last < 0 ?
			project->pou[ladder_canvas_pou(LADDER_CANVAS(of.sheet))].rung_count :
			of.first - 1 + of.last;
	} else if (of.networks) {
		of.last = ladder_fbd_view_count(of.networks);
	} else if (of.text) {
		of.last = gtk_text_buffer_get_line_count(of.text);
	}
	return of;
}

bool front_has_numbers(struct front *front)
{
	const struct numbers of = numbers_of(front);

	return of.first <= of.last;
}

static bool is_number(const struct numbers *of, const char *text, int *number)
{
	guint64 read;

	if (of->first > of->last ||
	    !g_ascii_string_to_unsigned(text, 10, (guint64)of->first, (guint64)of->last, &read,
					NULL))
		return false;
	*number = (int)read;
	return true;
}

/* The first GtkTextView in @within; NULL: none. */
static GtkTextView *view_in(GtkWidget *within)
{
	GtkTextView *found = GTK_IS_TEXT_VIEW(within) ? GTK_TEXT_VIEW(within) : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(within); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = view_in(child);
	return found;
}

static void go_line(struct front *front, GtkTextBuffer *text, int line)
{
	GtkTextView *view = view_in(page_content(front_tab(front)));
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(text, &at, line - 1);
	gtk_text_buffer_place_cursor(text, &at);
	if (!view)
		return;
	text_scroll_to_cursor(view);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

static void answered(AdwMessageDialog *dialog, const char *answer, struct front *front)
{
	GtkWidget *number = adw_message_dialog_get_extra_child(dialog);
	const struct numbers of = numbers_of(front);
	int to;

	if (g_strcmp0(answer, "go") != 0 ||
	    !is_number(&of, gtk_editable_get_text(GTK_EDITABLE(number)), &to))
		return;
	if (of.sheet)
		ladder_grid_view_go(of.sheet, to - of.first, -1, -1);
	else if (of.networks)
		ladder_fbd_view_go(of.networks, to - 1);
	else
		go_line(front, of.text, to);
}

static void typed(struct front *front, GtkWidget *number)
{
	AdwMessageDialog *dialog = ADW_MESSAGE_DIALOG(gtk_widget_get_root(number));
	const struct numbers of = numbers_of(front);
	const char *text = gtk_editable_get_text(GTK_EDITABLE(number));
	int to;
	const bool good = is_number(&of, text, &to), wrong = *text && !good;

	adw_message_dialog_set_response_enabled(dialog, "go", good);
	style_wrong(number, wrong);
}

void front_ask_number(struct front *front)
{
	const struct numbers of = numbers_of(front);
	AdwMessageDialog *dialog;
	GtkWidget *number;

	if (of.first > of.last) {
		messages_tell(front->core->messages, of.sheet ? _("no rung") :
			      _("There are no rungs or lines to go to"));
		return;
	}
	dialog = ask_new(front->core->window, of.sheet ? _("Go to rung") : of.networks ?
			 _("Go to network") : _("Go to line"),
			 NULL, "go", _("Go"), ADW_RESPONSE_DEFAULT);
	adw_message_dialog_format_body(dialog, _("%d to %d"), of.first, of.last);
	number = ask_entry(of.sheet ? _("Rung") : of.networks ? _("Network") : _("Line"));
	gtk_entry_set_input_purpose(GTK_ENTRY(number), GTK_INPUT_PURPOSE_DIGITS);
	adw_message_dialog_set_extra_child(dialog, number);
	adw_message_dialog_set_response_enabled(dialog, "go", FALSE);
	core_connect(front->core, number, "changed", G_CALLBACK(typed), front,
		     G_CONNECT_SWAPPED);
	core_connect(front->core, dialog, "response", G_CALLBACK(answered), front, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	gtk_widget_grab_focus(number);
}

/* ---- life ---- */

static GtkWidget *new_bar(struct front *front)
{
	GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
	GtkWidget *now = gtk_button_new_with_label(_("Show the newest scan"));

	front->label = GTK_LABEL(gtk_label_new(NULL));
	front->pous = GTK_DROP_DOWN(gtk_drop_down_new(NULL, NULL));
	gtk_label_set_xalign(front->label, 0);
	gtk_label_set_wrap(front->label, TRUE);
	gtk_widget_set_hexpand(GTK_WIDGET(front->label), TRUE);
	spoken_name(front->pous, _("Program or block"));
	gtk_actionable_set_action_name(GTK_ACTIONABLE(now), "win.sim_now");
	gtk_widget_set_valign(now, GTK_ALIGN_CENTER);
	gtk_widget_set_valign(GTK_WIDGET(front->pous), GTK_ALIGN_CENTER);
	gtk_widget_add_css_class(bar, "older-bar");
	gtk_box_append(GTK_BOX(bar), gtk_image_new_from_icon_name(
		"document-open-recent-symbolic"));
	gtk_box_append(GTK_BOX(bar), GTK_WIDGET(front->label));
	gtk_box_append(GTK_BOX(bar), GTK_WIDGET(front->pous));
	gtk_box_append(GTK_BOX(bar), now);
	return bar;
}

static void show_nothing(struct front *front)
{
	gtk_label_set_text(front->nothing_label, ladder_document_project(front->core->document) ?
		_("Nothing is open. Double-click a program in the tree to open it.") :
		_("Nothing is open. Double-click a problem below to open the file as text."));
	gtk_widget_set_visible(GTK_WIDGET(front->nothing_label),
			       adw_tab_view_get_n_pages(front->tabs) == 0);
}

void front_init(struct front *front, struct core *core)
{
	GtkWidget *place = gtk_widget_get_parent(front->now);

	front->core = core;
	front->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	gtk_widget_set_vexpand(front->box, TRUE);
	gtk_widget_set_visible(front->box, FALSE);
	gtk_box_append(GTK_BOX(front->box), new_bar(front));
	gtk_box_append(GTK_BOX(place), front->box);
	core_connect(core, front->tabs, "notify::n-pages", G_CALLBACK(show_nothing), front,
		     G_CONNECT_SWAPPED);
	core_connect(core, front->pous, "notify::selected", G_CALLBACK(chosen), front,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->sim, "program-changed", G_CALLBACK(program_changed), front,
		     G_CONNECT_SWAPPED);
}

void front_clear(struct front *front)
{
	g_clear_object(&front->older);
}

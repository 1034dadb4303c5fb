/* SPDX-License-Identifier: MIT
 *
 * tasks_view - the page of the tasks; see tasks_view.h.
 */
#include "editor-gtk/panels/tasks_view.h"

#include "editor-gtk/document/panel_cells.h"
#include "editor-gtk/document/task_rows.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/row_move.h"
#include "editor-gtk/panels/task_chart.h"
#include "editor-gtk/panels/task_delete.h"

#include <string.h>

#define INDENT 24 /* px of a program below its task                            */

/* LadderPanelRow: table is enum task_what, index the number of the row, number that of its
 * heading. */
enum { TASKS_FIXED = 1 }; /* LadderPanelRow.flags */

struct _LadderTasksView {
	GtkWidget parent_instance;
	GtkWidget *box, *program_button, *hint, *chart;
	GtkMenuButton *columns;
	struct panel_list list;
	struct panel_cells cells;
	struct panel_watch *watch;
	struct panel_message message;
	bool busy;              /* rows are replaced: a selection means nothing */
};

G_DEFINE_FINAL_TYPE(LadderTasksView, ladder_tasks_view, GTK_TYPE_WIDGET)

static LadderDocument *document_of(LadderTasksView *view)
{
	return panel_watch_document(view->watch);
}

/* @text: taken over; NULL: clears the message. */
static void tell(LadderTasksView *view, char *text)
{
	panel_message_set(&view->message, document_of(view), text);
}

/* ---- rows ---- */

static char *spoken(const struct task_rows *tasks, const struct task_row *row, const char *error)
{
	GString *text = g_string_new(row->text[TASKS_NAME]);
	const char *head = tasks->row[row->head].text[TASKS_NAME];

	for (int i = TASKS_PROGRAM; i < TASKS_FIELDS; i++)
		if (*row->text[i])
			g_string_append_printf(text, ", %s %s",
				task_rows_field_name((enum task_field)i), row->text[i]);
	if (row->what == TASKS_INSTANCE)
		g_string_append_printf(text, ", %s", head);
	if (error)
		g_string_append_printf(text, ". %s", error);
	return g_string_free(text, FALSE);
}

static LadderPanelRow *row_new(LadderDocument *document, const struct task_rows *tasks, int number)
{
	const struct task_row *of = &tasks->row[number];
	LadderPanelRow *row = ladder_panel_row_new();
	bool warning = false;

	for (int i = 0; i < TASKS_FIELDS; i++)
		row->text[i] = g_strdup(of->text[i]);
	row->table = (int)of->what;
	row->index = number;
	row->number = of->head;
	row->pou = of->pou;
	row->flags = tasks->fixed ? TASKS_FIXED : 0;
	row->note = task_rows_error(document, of, &warning);
	row->tone = !row->note ? PANEL_PLAIN : warning ? PANEL_WARNING : PANEL_ERROR;
	row->spoken = spoken(tasks, of, row->note);
	return row;
}

static void show_hint(LadderTasksView *view, const struct task_rows *tasks, bool project)
{
	const char *text = !project ? "" : tasks->fixed ?
		_("The CONFIGURATION is in another file. Open that file to change it.") :
		!tasks->written ?
		_("The file does not say which programs run: all of them run in each scan, in the "
		  "order of the file. Your first change here writes that into the file.") : "";

	gtk_label_set_text(GTK_LABEL(view->hint), text);
	gtk_widget_set_visible(view->hint, *text);
}

/* The buttons fit the selected row. */
static void show_actions_of(LadderTasksView *view, const struct task_rows *tasks)
{
	GtkWidget *widget = GTK_WIDGET(view);
	const LadderPanelRow *row = panel_list_row(&view->list);
	const bool can = row && tasks && row->index < tasks->count && !tasks->fixed;
	const bool line = can && row->table != TASKS_EACH_SCAN && row->table != TASKS_IDLE &&
			  tasks->row[tasks->row[row->index].head].what != TASKS_IDLE;

	gtk_widget_action_set_enabled(widget, "tasks.add", tasks && !tasks->fixed);
	gtk_widget_action_set_enabled(widget, "tasks.delete", line);
	gtk_widget_action_set_enabled(widget, "tasks.rename", line);
	gtk_widget_action_set_enabled(widget, "tasks.up",
				      can && task_rows_can_step(tasks, row->index, -1));
	gtk_widget_action_set_enabled(widget, "tasks.down",
				      can && task_rows_can_step(tasks, row->index, 1));
	gtk_widget_action_set_enabled(widget, "tasks.open", row && row->pou >= 0);
	gtk_widget_set_sensitive(view->program_button, can);
}

static void show_actions(LadderTasksView *view)
{
	LadderDocument *document = document_of(view);
	struct task_rows *tasks = document && !view->busy ? task_rows_new(document) : NULL;

	if (tasks)
		show_actions_of(view, tasks);
	task_rows_free(tasks);
}

static void show_chart(LadderTasksView *view, const struct task_rows *tasks)
{
	struct ladder *checked = ladder_document_checked(document_of(view));
	const struct program *program = checked ? ladder_program(checked) : NULL;

	ladder_task_chart_set(LADDER_TASK_CHART(view->chart), program ?
		schedule_new(program, TASKS_PERIOD_NS) : NULL, tasks);
}

static void refresh(GtkWidget *widget)
{
	LadderTasksView *view = LADDER_TASKS_VIEW(widget);
	LadderDocument *document = document_of(view);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	struct task_rows *tasks = document ? task_rows_new(document) : NULL;

	panel_message_age(&view->message, document);
	for (int i = 0; tasks && i < tasks->count; i++)
		g_ptr_array_add(rows, row_new(document, tasks, i));
	view->busy = true;
	panel_cells_update(&view->list, rows);
	view->busy = false;
	if (tasks)
		show_hint(view, tasks, ladder_document_project(document) != NULL);
	show_actions_of(view, tasks);
	if (tasks)
		show_chart(view, tasks);
	task_rows_free(tasks);
	g_ptr_array_unref(rows);
}

/* ---- edits of cells ---- */

/* The current number of a row, which may be older than the document; -1: gone. */
static int number_of(LadderTasksView *view, const LadderPanelRow *row)
{
	struct task_rows *tasks = task_rows_new(document_of(view));
	const int number = task_rows_find(tasks, (enum task_what)row->table,
				      panel_row_text(row, TASKS_NAME));

	task_rows_free(tasks);
	return number;
}

static const char *field_name(int field)
{
	return task_rows_field_name((enum task_field)field);
}

static bool set_field(GObject *owner, LadderPanelRow *row, int field, const char *text, char **why)
{
	LadderTasksView *view = LADDER_TASKS_VIEW(owner);
	const bool good = task_rows_set(document_of(view), number_of(view, row),
				    (enum task_field)field, text, why);

	tell(view, good ? NULL : g_strdup_printf(_("%s, %s: %s"), panel_row_text(row, TASKS_NAME),
		field_name(field), why && *why ? *why : ""));
	if (good) { /* Found by name again. */
		g_free(row->text[field]);
		row->text[field] = g_strstrip(g_strdup(text));
		panel_watch_later(view->watch);
	}
	return good;
}

static bool is_fixed(const LadderPanelRow *row, int field)
{
	return row->flags & TASKS_FIXED ||
	       !task_rows_has((enum task_what)row->table, (enum task_field)field);
}

static void dress(GtkWidget *cell, const LadderPanelRow *row, int field)
{
	const bool instance = row->table == TASKS_INSTANCE;

	if (field != TASKS_NAME)
		return;
	gtk_widget_set_margin_start(cell, instance ? INDENT : 0);
	if (instance)
		gtk_widget_remove_css_class(cell, "task-head");
	else
		gtk_widget_add_css_class(cell, "task-head");
}

static GPtrArray *choices(GObject *owner, int field)
{
	const struct project *project =
		ladder_document_project(document_of(LADDER_TASKS_VIEW(owner)));
	GPtrArray *all = g_ptr_array_new_with_free_func(g_free);

	for (int event = 0; field == TASKS_KIND && event < 2; event++) {
		g_ptr_array_add(all, g_strdup(task_rows_kind_name(event)));
		g_ptr_array_add(all, g_strdup(event ? _("when a variable becomes TRUE") :
					      _("with a period")));
	}
	for (int i = 0; field == TASKS_PROGRAM && project && i < project->pou_count; i++)
		if (project->pou[i].kind == POU_PROGRAM) {
			g_ptr_array_add(all, g_strdup(project_text(project,
								   project->pou[i].name)));
			g_ptr_array_add(all, g_strdup(""));
		}
	return all;
}

/* ---- edits of rows ---- */

/* Shows a row of this kind and name, and gives its cell the focus. */
static void go_to(LadderTasksView *view, enum task_what what, const char *name, int field)
{
	LadderPanelRow *like = ladder_panel_row_new();

	like->table = (int)what;
	like->text[TASKS_NAME] = g_strdup(name);
	panel_watch_later(view->watch);
	panel_watch_now(view->watch);
	if (panel_list_select(&view->list, panel_row_is_like, like) && field >= 0)
		cells_enter(view->list.view, panel_list_row(&view->list), field);
	g_object_unref(like);
}

/* Shows why an edit was refused, if it was. @why: taken over. */
static bool done(LadderTasksView *view, bool good, char *why)
{
	tell(view, good ? NULL : why ? why : g_strdup(""));
	if (good)
		g_free(why);
	return good;
}

static void add(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTasksView *view = LADDER_TASKS_VIEW(widget);
	char *name = NULL, *why = NULL;
	bool good;

	(void)action;
	(void)unused;
	if (!document_of(view))
		return;
	good = task_rows_add(document_of(view), &name, &why);
	if (done(view, good, why))
		go_to(view, TASKS_TASK, name, TASKS_NAME);
	g_free(name);
}

static void add_program(GtkWidget *widget, const char *action, GVariant *program)
{
	LadderTasksView *view = LADDER_TASKS_VIEW(widget);
	const char *text = g_variant_get_string(program, NULL);
	struct project *project = ladder_document_project(document_of(view));
	LadderPanelRow *row = panel_list_row(&view->list);
	char *name = NULL, *why = NULL;
	struct task_rows *tasks;
	bool good;
	int head;

	(void)action;
	if (!row || !project)
		return;
	tasks = task_rows_new(document_of(view));
	head = number_of(view, row);
	head = head >= 0 ? tasks->row[head].head : -1;
	task_rows_free(tasks);
	good = task_rows_add_program(document_of(view), head,
				     project_find_pou(project, text, strlen(text)), &name, &why);
	if (done(view, good, why))
		go_to(view, TASKS_INSTANCE, name, TASKS_NAME);
	g_free(name);
}

static void deleted(gpointer data, bool good, char *why)
{
	LadderTasksView *view = data;
	const guint at = gtk_single_selection_get_selected(view->list.selection);
	guint count;

	if (!view->box || !done(view, good, why)) /* the page was closed meanwhile */
		return;
	panel_watch_later(view->watch);
	panel_watch_now(view->watch);
	count = g_list_model_get_n_items(G_LIST_MODEL(view->list.selection));
	panel_list_go(&view->list, MIN(at, count - 1));
	gtk_widget_grab_focus(GTK_WIDGET(view->list.view));
}

static void delete(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTasksView *view = LADDER_TASKS_VIEW(widget);
	LadderPanelRow *row = panel_list_row(&view->list);

	(void)action;
	(void)unused;
	if (row)
		task_delete_ask(GTK_WINDOW(gtk_widget_get_root(widget)), document_of(view),
				(enum task_what)row->table, panel_row_text(row, TASKS_NAME),
				deleted, G_OBJECT(view));
}

static void rename_row(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTasksView *view = LADDER_TASKS_VIEW(widget);
	LadderPanelRow *row = panel_list_row(&view->list);

	(void)action;
	(void)unused;
	if (row)
		cells_enter(view->list.view, row, TASKS_NAME);
}

static void step(LadderTasksView *view, int by)
{
	LadderPanelRow *row = panel_list_row(&view->list);
	int field = TASKS_NAME;
	char *name, *why = NULL;
	bool good;
	int what;

	if (!row)
		return;
	cells_focused(view->list.view, &field);
	if (!panel_cells_commit(view->list.view))
		return;
	name = g_strdup(panel_row_text(row, TASKS_NAME));
	what = row->table;
	good = task_rows_step(document_of(view), number_of(view, row), by, &why);
	if (done(view, good, why))
		go_to(view, (enum task_what)what, name, field);
	g_free(name);
}

static void up(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	step(LADDER_TASKS_VIEW(widget), -1);
}

static void down(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	step(LADDER_TASKS_VIEW(widget), 1);
}

static void open_program(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderPanelRow *row = panel_list_row(&LADDER_TASKS_VIEW(widget)->list);

	(void)action;
	(void)unused;
	if (row && row->pou >= 0)
		gtk_widget_activate_action(widget, "win.go-to", "(iiii)", row->pou, 0, -1, -1);
}

/* ---- menus ---- */

/* Where a program runs now: "Lazy (now in Slow)". Caller frees. */
static char *label_of(const struct task_rows *tasks, int row)
{
	const struct task_row *of = &tasks->row[row];

	return tasks->row[of->head].what == TASKS_IDLE ? g_strdup(of->text[TASKS_PROGRAM]) :
	       g_strdup_printf(_("%s (now in %s)"), of->text[TASKS_PROGRAM],
			       tasks->row[of->head].text[TASKS_NAME]);
}

/* The programs that are not below the selected heading; NULL: none. */
static GMenu *programs_menu(LadderTasksView *view)
{
	const LadderPanelRow *row = panel_list_row(&view->list);
	struct task_rows *tasks = task_rows_new(document_of(view));
	GMenu *menu = g_menu_new();

	for (int i = 0; row && i < tasks->count; i++) {
		const struct task_row *of = &tasks->row[i];
		GMenuItem *item;
		char *label;

		if (of->what != TASKS_INSTANCE || of->pou < 0 || of->head == row->number)
			continue;
		label = label_of(tasks, i);
		item = g_menu_item_new(label, NULL);
		g_menu_item_set_action_and_target(item, "tasks.add-program", "s",
						  of->text[TASKS_PROGRAM]);
		g_menu_append_item(menu, item);
		g_object_unref(item);
		g_free(label);
	}
	task_rows_free(tasks);
	if (!g_menu_model_get_n_items(G_MENU_MODEL(menu)))
		g_clear_object(&menu);
	return menu;
}

static void program_clicked(GtkButton *button, LadderTasksView *view)
{
	GMenu *menu = programs_menu(view);
	GtkWidget *widget = GTK_WIDGET(button);

	if (menu)
		popover_menu(GTK_WIDGET(view), menu, &(GdkRectangle){ 0, 0, 1, 1 }, widget);
	else
		tell(view, g_strdup(_("All programs run in this task already")));
}

static GMenu *row_menu(LadderTasksView *view)
{
	GMenu *menu = g_menu_new(), *programs = programs_menu(view);

	g_menu_append(menu, _("New task"), "tasks.add");
	if (programs) {
		g_menu_append_submenu(menu, _("Add program"), G_MENU_MODEL(programs));
		g_object_unref(programs);
	}
	g_menu_append(menu, _("Open program"), "tasks.open");
	g_menu_append(menu, _("Move up"), "tasks.up");
	g_menu_append(menu, _("Move down"), "tasks.down");
	g_menu_append(menu, _("Rename"), "tasks.rename");
	g_menu_append(menu, _("Delete"), "tasks.delete");
	return menu;
}

static void show_menu(LadderTasksView *view, double x, double y)
{
	GtkWidget *table = GTK_WIDGET(view->list.view);
	GtkRoot *root = gtk_widget_get_root(table);
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;

	gtk_widget_translate_coordinates(table, GTK_WIDGET(view), x, y, &x, &y);
	popover_menu(GTK_WIDGET(view), row_menu(view), &(GdkRectangle){ (int)x, (int)y, 1, 1 },
		     focus ? focus : table);
}

/* Before the entry of a cell opens its own menu. */
static void right_pressed(GtkGestureClick *click, int count, double x, double y,
			  LadderTasksView *view)
{
	GtkListItem *item = row_move_at(GTK_WIDGET(view->list.view), x, y);

	(void)count;
	gtk_gesture_set_state(GTK_GESTURE(click), GTK_EVENT_SEQUENCE_CLAIMED);
	if (item) {
		panel_list_go(&view->list, gtk_list_item_get_position(item));
		show_menu(view, x, y);
	}
}

/* Is the focus on a name that is selected as a whole and not edited? The focus of a row goes there. */
static bool has_whole_name(LadderTasksView *view)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(view));
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;
	int field = -1, from, to;
	const LadderPanelRow *row = cells_focused(view->list.view, &field);
	const char *text;

	if (!row || field != TASKS_NAME || !GTK_IS_EDITABLE(focus))
		return false;
	text = gtk_editable_get_text(GTK_EDITABLE(focus));
	return strcmp(text, panel_row_text(row, TASKS_NAME)) == 0 &&
	       gtk_editable_get_selection_bounds(GTK_EDITABLE(focus), &from, &to) &&
	       to - from == (int)g_utf8_strlen(text, -1);
}

/* Before the cells. Delete on a whole name deletes the row, as no name is empty; Ctrl+Delete deletes
 * it from each of its cells, as a rung of a sheet. */
static gboolean early_key(GtkEventControllerKey *keys, guint key, guint code,
			 GdkModifierType state, LadderTasksView *view)
{
	const GdkModifierType held = state & gtk_accelerator_get_default_mod_mask();

	(void)keys;
	(void)code;
	if (key == GDK_KEY_Delete && (held == GDK_CONTROL_MASK ||
				      (!held && has_whole_name(view)))) {
		gtk_widget_activate_action(GTK_WIDGET(view), "tasks.delete", NULL);
		return TRUE;
	}
	if (key != GDK_KEY_Menu && !(key == GDK_KEY_F10 && state & GDK_SHIFT_MASK))
		return FALSE;
	show_menu(view, INDENT, INDENT);
	return TRUE;
}

/* ---- dragging ---- */

static const char *name_of(gpointer view, gpointer of)
{
	const LadderPanelRow *row = of;

	(void)view;
	return row->flags & TASKS_FIXED || row->table == TASKS_EACH_SCAN ||
	       row->table == TASKS_IDLE ? NULL : panel_row_text(row, TASKS_NAME);
}

/* A program goes below the heading of a task; a task goes before or behind a whole one. */
static bool fits(gpointer view, gpointer of, gpointer target, bool *below)
{
	const LadderPanelRow *row = of, *at = target;

	*below |= at->index == at->number && row->table != TASKS_TASK;
	return number_of(view, row) >= 0 && number_of(view, at) >= 0;
}

static void move_to(gpointer owner, gpointer of, gpointer target, bool below)
{
	LadderTasksView *view = owner;
	LadderPanelRow *row = of;
	char *name = g_strdup(panel_row_text(row, TASKS_NAME)), *why = NULL;
	const int what = row->table;
	const bool good = task_rows_drop(document_of(view), number_of(view, row),
					 number_of(view, target), below, &why);

	if (done(view, good, why))
		go_to(view, (enum task_what)what, name, -1);
	g_free(name);
}

static const struct row_move moving = {
	.up = "tasks.up", .down = "tasks.down", .name = name_of, .fits = fits, .move = move_to,
};

/* ---- the widget ---- */

void ladder_tasks_view_show(LadderTasksView *view, const char *task)
{
	struct task_rows *tasks = task_rows_new(document_of(view));
	const bool found = task_rows_find(tasks, TASKS_TASK, task) >= 0;

	task_rows_free(tasks);
	if (found)
		go_to(view, TASKS_TASK, task, TASKS_NAME);
	else
		go_to(view, TASKS_EACH_SCAN, _("Each scan"), TASKS_WHEN);
}

static void dispose(GObject *object)
{
	LadderTasksView *view = LADDER_TASKS_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	panel_list_clear(&view->list);
	G_OBJECT_CLASS(ladder_tasks_view_parent_class)->dispose(object);
}

static void ladder_tasks_view_class_init(LadderTasksViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	g_type_ensure(LADDER_TYPE_TASK_CHART);
	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_install_action(widget, "tasks.add", NULL, add);
	gtk_widget_class_install_action(widget, "tasks.add-program", "s", add_program);
	gtk_widget_class_install_action(widget, "tasks.delete", NULL, delete);
	gtk_widget_class_install_action(widget, "tasks.rename", NULL, rename_row);
	gtk_widget_class_install_action(widget, "tasks.up", NULL, up);
	gtk_widget_class_install_action(widget, "tasks.down", NULL, down);
	gtk_widget_class_install_action(widget, "tasks.open", NULL, open_program);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/tasks_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderTasksView, name)
	CHILD(box); CHILD(program_button); CHILD(columns); CHILD(hint); CHILD(chart);
#undef CHILD
	panel_bind_list(widget, LadderTasksView);
	panel_bind_message(widget, LadderTasksView);
	gtk_widget_class_bind_template_callback(widget, program_clicked);
}

static void add_columns(LadderTasksView *view)
{
	static const struct { enum task_field field; int width; } column[] = {
		{ TASKS_NAME, 170 }, { TASKS_PROGRAM, 124 }, { TASKS_KIND, 106 },
		{ TASKS_WHEN, 120 }, { TASKS_PRIORITY, 70 }, { TASKS_WATCHDOG, 90 },
		{ TASKS_COMMENT, 140 },
	};
	static const int leaving[] = { TASKS_COMMENT, TASKS_WATCHDOG, TASKS_PRIORITY };

	view->cells = (struct panel_cells){ .owner = G_OBJECT(view), .name = field_name,
		.choosable = 1u << TASKS_KIND | 1u << TASKS_PROGRAM, .choices = choices,
		.set = set_field, .is_fixed = is_fixed, .dress = dress };
	panel_list_column(&view->list, "", TASKS_NAME, PANEL_ICON, 0);
	for (gsize i = 0; i < G_N_ELEMENTS(column); i++)
		panel_cells_add(&view->list, &view->cells, (int)column[i].field,
				column[i].field == TASKS_COMMENT ? PANEL_EXPAND :
				column[i].field == TASKS_NAME ? PANEL_BOLD : 0,
				column[i].width);
	panel_list_unsort(&view->list);
	panel_list_may_leave(&view->list, leaving, G_N_ELEMENTS(leaving), view->columns);
	row_move_add(GTK_WIDGET(view->list.view), &moving, view);
}

static void add_controllers(LadderTasksView *view)
{
	GtkWidget *table = GTK_WIDGET(view->list.view);
	GtkGesture *click = gtk_gesture_click_new();
	GtkEventController *menu = gtk_event_controller_key_new();

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_SECONDARY);
	gtk_event_controller_set_propagation_phase(GTK_EVENT_CONTROLLER(click),
						   GTK_PHASE_CAPTURE);
	gtk_event_controller_set_propagation_phase(menu, GTK_PHASE_CAPTURE);
	g_signal_connect(click, "pressed", G_CALLBACK(right_pressed), view);
	g_signal_connect(menu, "key-pressed", G_CALLBACK(early_key), view);
	gtk_widget_add_controller(table, GTK_EVENT_CONTROLLER(click));
	gtk_widget_add_controller(table, menu);
}

static void ladder_tasks_view_init(LadderTasksView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);

	gtk_widget_init_template(widget);
	panel_list_init(&view->list, view->list.view);
	panel_message_init(&view->message, view->message.label);
	add_columns(view);
	add_controllers(view);
	panel_list_follow(&view->list, G_CALLBACK(show_actions), view);
	view->watch = panel_watch_new(widget, true, refresh);
}

void ladder_tasks_view_follow(LadderTasksView *view, LadderSim *sim)
{
	ladder_task_chart_follow(LADDER_TASK_CHART(view->chart), sim);
}

GtkWidget *ladder_tasks_view_new(LadderDocument *document)
{
	LadderTasksView *view = g_object_new(LADDER_TYPE_TASKS_VIEW, NULL);

	panel_watch_set(view->watch, document);
	return GTK_WIDGET(view);
}

/* SPDX-License-Identifier: MIT
 *
 * device_view - see device_view.h.
 */
#include "editor-gtk/panels/device_view.h"

#include "editor-gtk/panels/clock_part.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_value.h"

#include "engine/base/digest.h"
#include "engine/scan/resource.h"
#include "online/event.h"

#include <string.h>

#define TASK_COLUMNS 8
enum { FORCE_NAME, FORCE_VALUE, FORCE_ELSE, FORCE_COLUMNS };

struct device {
	GtkWidget *view;
	LadderBoardLink *link;
	GtkWidget *empty, *body;
	GtkGrid *facts, *tasks, *forces;
	GtkWidget *tasks_part, *forces_part, *release;
	int row;             /* of `facts` that is filled next                */
};

static void device_free(gpointer pointer)
{
	struct device *device = pointer;

	g_signal_handlers_disconnect_by_data(device->link, device);
	g_object_unref(device->link);
	g_free(device);
}

/* ---- texts ---- */

/* Lengths of scans are far below a millisecond. Caller frees. */
static char *time_text(int64_t ns)
{
	char text[32];

	if (ns < 1000000)
		return g_strdup_printf("%.1f µs", (double)ns / 1e3);
	if (ns < 1000000000)
		return g_strdup_printf("%.2f ms", (double)ns / 1e6);
	live_time_print(ns, text, sizeof(text));
	return g_strdup(text);
}

static char *three_times(int64_t mean, int64_t most, int64_t p999)
{
	char *a = time_text(mean), *b = time_text(p999), *c = time_text(most);
	char *text = g_strdup_printf(_("%s on average, 99.9 %% at most %s, longest %s"), a, b, c);

	g_free(a);
	g_free(b);
	g_free(c);
	return text;
}

static char *lines_text(const struct board_status *status)
{
	static const char *const quality[] = { N_("good"), N_("some do not answer: inputs may be old"),
					       N_("fault") };

	return g_strdup_printf("%u: %s", status->lines,
			       status->io < G_N_ELEMENTS(quality) ? _(quality[status->io]) : "?");
}

/* "2 good, 1 stale, 1 in fault"; NULL: the map has none. Caller frees. */
static char *values_text(const struct values_status *values)
{
	return values->good + values->stale + values->fault == 0 ? NULL :
	       g_strdup_printf(_("%u good, %u stale, %u in fault"), values->good, values->stale, values->fault);
}

/* A line for each value that is not good: "%AIW0 ⚠ stale"; NULL: all are. Caller frees. */
static char *bad_text(const struct values_status *values)
{
	GString *text = g_string_new(NULL);
	char *all;

	for (guint i = 0; i < values->count; i++)
		g_string_append_printf(text, "%s%s %s", i ? "\n" : "", values->bad[i].address, live_quality_text(
			values->bad[i].flags & VALUE_FAULT ? SIM_VALUE_FAULT : SIM_STALE));
	if (values->count && values->count < values->stale + values->fault)
		g_string_append(text, "\n…");
	all = values->count ? g_utf8_make_valid(text->str, -1) : NULL;
	g_string_free(text, TRUE);
	return all;
}

static const char *gateway_name(const struct gateway_status *gateway, char *out, gsize size)
{
	g_snprintf(out, size, _("Gateway %s"), gateway->driver);
	return out;
}

/* "points: 4, 1 bus, 2 units", and a line for each unit. Caller frees. */
static char *gateway_text(const struct gateway_status *gateway)
{
	GString *text = g_string_new(NULL);
	char *all;

	g_string_append_printf(text, _("points: %u"), gateway->points);
	g_string_append_printf(text, "%s%s", !gateway->runs || *gateway->report.text ? ", " : "",
			       gateway->runs ? gateway->report.text : _("the program is not there"));
	for (guint i = 0; gateway->runs && i < gateway->report.count; i++) {
		const struct gateway_unit *unit = &gateway->report.unit[i];

		g_string_append_printf(text, "\n%s: ", unit->name);
		g_string_append_printf(text, _("requests: %llu, errors: %llu, without an answer: %llu"),
				       (unsigned long long)unit->requests, (unsigned long long)unit->errors,
				       (unsigned long long)unit->timeouts);
	}
	all = g_utf8_make_valid(text->str, -1);
	g_string_free(text, TRUE);
	return all;
}

/* ---- cells ---- */

/* The label at a place of @grid, made when it is first asked for. */
static GtkLabel *label_at(GtkGrid *grid, int column, int row)
{
	GtkWidget *label = gtk_grid_get_child_at(grid, column, row);

	if (!label) {
		g_autoptr(PangoAttrList) whole = pango_attr_list_new();

		/* A name that is wrapped gets no hyphen, which could be one of its letters. */
		pango_attr_list_insert(whole, pango_attr_insert_hyphens_new(FALSE));
		label = gtk_label_new("");
		gtk_label_set_attributes(GTK_LABEL(label), whole);
		gtk_label_set_xalign(GTK_LABEL(label), 0);
		gtk_label_set_wrap(GTK_LABEL(label), TRUE);
		gtk_label_set_wrap_mode(GTK_LABEL(label), PANGO_WRAP_WORD_CHAR);
		gtk_label_set_selectable(GTK_LABEL(label), TRUE);
		gtk_widget_set_valign(label, GTK_ALIGN_BASELINE);
		gtk_grid_attach(grid, label, column, row, 1, 1);
	}
	return GTK_LABEL(label);
}

static void put(GtkGrid *grid, int column, int row, const char *text)
{
	GtkLabel *label = label_at(grid, column, row);

	if (strcmp(gtk_label_get_text(label), text) != 0)
		gtk_label_set_text(label, text);
}

static void remove_rows(GtkGrid *grid, int first)
{
	while (gtk_grid_get_child_at(grid, 0, first))
		gtk_grid_remove_row(grid, first);
}

/* @text: taken over; NULL or "": the fact is left out. */
static void fact(struct device *device, const char *name, char *text)
{
	if (text && *text) {
		put(device->facts, 0, device->row, name);
		gtk_widget_add_css_class(GTK_WIDGET(label_at(device->facts, 0, device->row)), "dim-label");
		gtk_label_set_selectable(label_at(device->facts, 0, device->row), FALSE);
		put(device->facts, 1, device->row, text);
		spoken_name(GTK_WIDGET(label_at(device->facts, 1, device->row)), name);
		device->row++;
	}
	g_free(text);
}

/* ---- what is shown ---- */

/* Why the next start runs another program; NULL: it does not. */
static char *next_text(const struct board_status *status)
{
	const char *text = event_text(status->next);
	char next[512];

	if (!status->next)
		return NULL;
	status_next(status, text ? said(text) : NULL, next, sizeof(next));
	return g_strdup(next);
}

/* How this start came about; NULL: the board does not know. */
static char *began_text(const struct board_status *status)
{
	const char *text = event_text(status->began);
	char began[512];

	if (!status->began)
		return NULL;
	status_began(status, text ? said(text) : NULL, began, sizeof(began));
	return g_strdup(began);
}

static void show_facts(struct device *device, const struct board_status *status)
{
	const struct values_status *values = ladder_board_link_values(device->link);
	const struct gateways_status *gateways = ladder_board_link_gateways(device->link);
	char program[65], name[64];

	event_program(status->program, program);
	device->row = 0;
	fact(device, _("Board"), g_strdup(ladder_board_link_board(device->link)));
	fact(device, _("Place"), g_strdup(ladder_board_link_where(device->link)));
	fact(device, _("ladderd"), g_strdup(status->version));
	fact(device, _("Your role"), g_strdup(role_word(ladder_board_link_role(device->link))));
	fact(device, _("Sessions"), g_strdup_printf("%u", status->sessions));
	fact(device, _("Mode"), g_strdup(mode_word(status->mode)));
	fact(device, _("Fault"), status->mode == STATE_FAULT ? g_strdup(status->fault) : NULL);
	fact(device, _("STOP of the program"), g_strdup(status->stop));
	fact(device, _("Next start"), next_text(status));
	fact(device, _("Before this start"), began_text(status));
	fact(device, _("Disk"), g_strdup(status->disk));
	fact(device, _("Program"), g_strdup(program));
	fact(device, _("Runs for"), time_text((int64_t)status->up_ms * 1000000));
	fact(device, _("Period"), time_text(status->period_ns));
	fact(device, _("Scans"), g_strdup_printf("%" G_GUINT64_FORMAT, status->scans));
	fact(device, _("Missed scans"), g_strdup_printf("%" G_GUINT64_FORMAT, status->late));
	fact(device, _("A scan takes"), three_times(status->scan_mean_ns, status->scan_max_ns,
						    status->scan_p999_ns));
	fact(device, _("Speed of the board, words/ms"), status->speed ?
	     g_strdup_printf("%u", status->speed) : NULL);
	fact(device, _("A scan begins late by"), three_times(status->wake_mean_ns,
		status->wake_max_ns, status->wake_p999_ns));
	fact(device, _("Operations that failed"), *status->error ?
	     g_strdup_printf("%u: %s", status->errors, status->error) :
	     g_strdup_printf("%u", status->errors));
	fact(device, _("Lines of the I/O map"), lines_text(status));
	fact(device, _("Calls to lines that failed"),
	     g_strdup_printf("%" G_GUINT64_FORMAT, status->io_failed));
	fact(device, _("Values of the I/O map"), values_text(values));
	fact(device, _("Values that are not good"), bad_text(values));
	for (guint i = 0; i < gateways->count; i++)
		fact(device, gateway_name(&gateways->gateway[i], name, sizeof(name)), gateway_text(&gateways->gateway[i]));
	fact(device, _("Memory in use"), g_strdup_printf("%" G_GUINT64_FORMAT " KB",
						  (status->memory_bytes + 1023) / 1024));
	fact(device, _("Processor"), g_strdup_printf("%u.%u %%", status->cpu_permille / 10,
						     status->cpu_permille % 10));
	remove_rows(device->facts, device->row);
}

static void show_tasks(struct device *device, const struct board_status *status)
{
	for (int i = 0; i < status->task_count; i++) {
		const struct task_status *task = &status->task[i];
		char *cell[TASK_COLUMNS] = {
			g_strdup(task->name),
			task->interval_ns ? time_text(task->interval_ns) : g_strdup("–"),
			g_strdup_printf("%" G_GUINT64_FORMAT, task->runs),
			g_strdup_printf("%" G_GUINT64_FORMAT, task->overruns),
			time_text(task->last_ns), time_text(task->max_ns),
			task->interval_ns ? time_text(task->wait_ns) : g_strdup("–"),
			g_strdup_printf("%" G_GUINT64_FORMAT, task->interrupted),
		};

		for (int j = 0; j < TASK_COLUMNS; j++) {
			put(device->tasks, j, i + 1, cell[j]);
			g_free(cell[j]);
		}
	}
	remove_rows(device->tasks, status->task_count + 1);
	gtk_widget_set_visible(device->tasks_part, status->task_count > 0);
}

static void forces_came(gpointer data, struct board_answer *answer)
{
	struct device *device = data;
	const uint16_t count = answer->end == DESK_GOOD ? wire_u16(&answer->body) : 0;
	int row = 1;

	for (uint16_t i = 0; i < count; i++) {
		char name[LIMIT_PARTS], text[IEC_VALUE_TEXT], *valid;
		enum iec_type type;
		union iec_value value;

		wire_u32(&answer->body);
		wire_copy_text(&answer->body, name, sizeof(name));
		type = (enum iec_type)wire_u8(&answer->body);
		valid = g_utf8_make_valid(name, -1);
		put(device->forces, FORCE_NAME, row, valid);
		g_free(valid);
		for (int j = FORCE_VALUE; j <= FORCE_ELSE; j++) {
			struct iec_text room;

			value = wire_value(&answer->body, type, &room);
			if (answer->body.failed)
				break;
			live_value_print(type, value, text, sizeof(text));
			put(device->forces, j, row, text);
		}
		if (answer->body.failed)
			break;
		row++;
	}
	remove_rows(device->forces, row);
	gtk_widget_set_visible(device->forces_part, row > 1);
}

static void ask_forces(struct device *device, const struct board_status *status)
{
	struct wire_writer fields;

	if (!status->forces || !ladder_board_link_may(device->link, SERVICE_FORCES)) {
		gtk_widget_set_visible(device->forces_part, FALSE);
		return;
	}
	fields = ladder_board_link_begin(device->link);
	ladder_board_link_send(device->link, SERVICE_FORCES, &fields, device->view, forces_came,
			       device);
}

static void show(struct device *device)
{
	const struct board_status *status = ladder_board_link_status(device->link);

	gtk_widget_set_visible(device->empty, !status);
	gtk_widget_set_visible(device->body, status != NULL);
	if (!status || !gtk_widget_get_mapped(device->view))
		return;
	show_facts(device, status);
	show_tasks(device, status);
	ask_forces(device, status);
}

/* ---- life ---- */

static GtkGrid *grid_new(const char *const *heading, int columns)
{
	GtkGrid *grid = GTK_GRID(gtk_grid_new());

	gtk_grid_set_column_spacing(grid, 24);
	gtk_grid_set_row_spacing(grid, 4);
	for (int i = 0; i < columns; i++) {
		put(grid, i, 0, _(heading[i]));
		gtk_widget_add_css_class(GTK_WIDGET(label_at(grid, i, 0)), "dim-label");
	}
	return grid;
}

/* A heading, a grid below it. */
static GtkWidget *part_new(const char *heading, GtkGrid *grid)
{
	GtkWidget *part = gtk_box_new(GTK_ORIENTATION_VERTICAL, 8), *label = gtk_label_new(heading);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_add_css_class(label, "heading");
	gtk_box_append(GTK_BOX(part), label);
	gtk_box_append(GTK_BOX(part), GTK_WIDGET(grid));
	return part;
}

static void make_body(struct device *device)
{
	static const char *const tasks[] = { N_("Task"), N_("Interval"), N_("Runs"), N_("Missed"),
					     N_("Last run"), N_("Longest run"), N_("Longest wait"),
					     N_("Interrupted") };
	static const char *const forces[] = { N_("Variable"), N_("Held at"), N_("Without the force") };

	device->body = gtk_box_new(GTK_ORIENTATION_VERTICAL, 24);
	gtk_widget_add_css_class(device->body, "device");
	device->facts = grid_new(NULL, 0);
	device->tasks = grid_new(tasks, TASK_COLUMNS);
	device->forces = grid_new(forces, FORCE_COLUMNS);
	device->forces_part = part_new(_("Forces"), device->forces);
	device->release = gtk_button_new_with_label(_("Release all forces"));
	gtk_widget_set_halign(device->release, GTK_ALIGN_START);
	gtk_actionable_set_action_name(GTK_ACTIONABLE(device->release), "win.sim_release");
	gtk_box_append(GTK_BOX(device->forces_part), device->release);
	device->tasks_part = part_new(_("Tasks"), device->tasks);
	gtk_box_append(GTK_BOX(device->body), GTK_WIDGET(device->facts));
	gtk_box_append(GTK_BOX(device->body), ladder_clock_part_new(device->link));
	gtk_box_append(GTK_BOX(device->body), device->forces_part);
	gtk_box_append(GTK_BOX(device->body), device->tasks_part);
}

GtkWidget *ladder_device_view_new(LadderBoardLink *link)
{
	struct device *device = g_new0(struct device, 1);
	GtkWidget *view = gtk_scrolled_window_new(), *inside = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);

	device->view = view;
	device->link = g_object_ref(link);
	device->empty = gtk_label_new(_("No board is connected."));
	gtk_widget_add_css_class(device->empty, "dim-label");
	gtk_widget_set_vexpand(device->empty, TRUE);
	make_body(device);
	gtk_box_append(GTK_BOX(inside), device->empty);
	gtk_box_append(GTK_BOX(inside), device->body);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(view), inside);
	spoken_name(view, _("Connected board"));
	g_object_set_data_full(G_OBJECT(view), "device", device, device_free);
	g_signal_connect_swapped(link, "status", G_CALLBACK(show), device);
	g_signal_connect_swapped(link, "state-changed", G_CALLBACK(show), device);
	g_signal_connect_swapped(view, "map", G_CALLBACK(show), device);
	show(device);
	return view;
}

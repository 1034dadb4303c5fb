/* SPDX-License-Identifier: MIT
 *
 * import_dialog - shows what an import of symbols would change; see import_dialog.h.
 */
#include "editor-gtk/panels/import_dialog.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/document/panel.h"

enum { IMPORT_LINE, IMPORT_NAME, IMPORT_ACTION, IMPORT_TEXT };

struct _LadderImportDialog {
	GtkWindow parent_instance;
	GtkWidget *summary;
	struct panel_list list;
	struct csv_plan *plan;
};

G_DEFINE_FINAL_TYPE(LadderImportDialog, ladder_import_dialog, GTK_TYPE_WINDOW)

static const char *action_text(enum csv_action action)
{
	static const char *const text[] = {
		[CSV_ADD] = N_("new"), [CSV_CHANGE] = N_("changed"),
		[CSV_SAME] = N_("unchanged"), [CSV_REFUSE] = N_("refused"),
	};

	return _(text[action]);
}

static enum panel_tone tone_of(const struct csv_entry *entry)
{
	if (entry->fault)
		return entry->warning ? PANEL_WARNING : PANEL_ERROR;
	return entry->action == CSV_REFUSE ? PANEL_ERROR : PANEL_PLAIN;
}

static LadderPanelRow *row_of(const struct csv_entry *entry)
{
	LadderPanelRow *row = ladder_panel_row_new();

	row->text[IMPORT_LINE] = g_strdup_printf("%d", entry->line);
	row->text[IMPORT_NAME] = g_strdup(entry->name);
	row->text[IMPORT_ACTION] = g_strdup(action_text(entry->action));
	row->text[IMPORT_TEXT] = entry->fault ?
		g_strdup_printf("%s – %s", entry->fault, entry->text) : g_strdup(entry->text);
	row->number = entry->line;
	row->tone = tone_of(entry);
	row->note = row->tone == PANEL_PLAIN ? NULL : g_strdup(row->text[IMPORT_TEXT]);
	row->spoken = g_strdup_printf(_("line %d, %s, %s, %s"), entry->line, entry->name,
				      action_text(entry->action), row->text[IMPORT_TEXT]);
	return row;
}

static void apply(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderImportDialog *dialog = LADDER_IMPORT_DIALOG(widget);
	char *why = NULL;

	(void)action;
	(void)unused;
	if (csv_plan_apply(dialog->plan, &why)) {
		gtk_window_close(GTK_WINDOW(dialog));
		return;
	}
	gtk_label_set_text(GTK_LABEL(dialog->summary), why);
	gtk_widget_add_css_class(dialog->summary, "error");
	gtk_widget_action_set_enabled(widget, "import.apply", FALSE);
	g_free(why);
}

static void cancel(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	gtk_window_close(GTK_WINDOW(widget));
}

/* Enter imports, also while a row has the focus. */
static void row_activated(GtkWidget *dialog)
{
	gtk_widget_activate_action(dialog, "import.apply", NULL);
}

/* Caller frees. */
static char *summary_of(const struct csv_plan *plan)
{
	char *counts = g_strdup_printf(_("%d new, %d changed, %d unchanged, %d refused"),
		plan->counts[CSV_ADD], plan->counts[CSV_CHANGE], plan->counts[CSV_SAME],
		plan->counts[CSV_REFUSE]);
	char *faults, *both;

	if (!plan->faults)
		return counts;
	faults = g_strdup_printf(ngettext("after %d of these lines the program has a fault",
		"after %d of these lines the program has faults", (gulong)plan->faults),
		plan->faults);
	both = g_strdup_printf("%s; %s", counts, faults);
	g_free(faults);
	g_free(counts);
	return both;
}

static void dispose(GObject *object)
{
	LadderImportDialog *dialog = LADDER_IMPORT_DIALOG(object);

	panel_list_clear(&dialog->list);
	g_clear_pointer(&dialog->plan, csv_plan_free);
	G_OBJECT_CLASS(ladder_import_dialog_parent_class)->dispose(object);
}

static void ladder_import_dialog_class_init(LadderImportDialogClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/import_dialog.ui");
	gtk_widget_class_bind_template_child(widget, LadderImportDialog, summary);
	panel_bind_list(widget, LadderImportDialog);
	gtk_widget_class_install_action(widget, "import.apply", NULL, apply);
	gtk_widget_class_install_action(widget, "import.cancel", NULL, cancel);
	gtk_widget_class_bind_template_callback(widget, row_activated);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Return, 0, "import.apply", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_KP_Enter, 0, "import.apply", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Escape, 0, "import.cancel",
					    NULL);
}

static void ladder_import_dialog_init(LadderImportDialog *dialog)
{
	gtk_widget_init_template(GTK_WIDGET(dialog));
	panel_list_init(&dialog->list, dialog->list.view);
	panel_list_column(&dialog->list, "", IMPORT_ACTION, PANEL_ICON, 0);
	panel_list_column(&dialog->list, _("Line"), IMPORT_LINE, PANEL_NUMBER, 70);
	panel_list_column(&dialog->list, _("Symbol"), IMPORT_NAME, 0, 170);
	panel_list_column(&dialog->list, _("Result"), IMPORT_ACTION, 0, 110);
	panel_list_column(&dialog->list, _("What changes"), IMPORT_TEXT, PANEL_EXPAND, 0);
}

GtkWidget *ladder_import_dialog_new(struct csv_plan *plan, const char *from)
{
	LadderImportDialog *dialog = g_object_new(LADDER_TYPE_IMPORT_DIALOG, NULL);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	char *title = g_strdup_printf(_("Import symbols from %s"), from);
	char *summary = summary_of(plan);

	dialog->plan = plan;
	for (guint i = 0; i < plan->entry->len; i++)
		g_ptr_array_add(rows, row_of(plan->entry->pdata[i]));
	panel_list_update(&dialog->list, rows);
	gtk_window_set_title(GTK_WINDOW(dialog), title);
	gtk_label_set_text(GTK_LABEL(dialog->summary), summary);
	gtk_widget_action_set_enabled(GTK_WIDGET(dialog), "import.apply",
				      plan->counts[CSV_ADD] || plan->counts[CSV_CHANGE]);
	g_ptr_array_unref(rows);
	g_free(title);
	g_free(summary);
	return GTK_WIDGET(dialog);
}

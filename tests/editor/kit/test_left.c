/* SPDX-License-Identifier: MIT
 *
 * test_left - what is done when the focus leaves comes after GTK has moved it, once, and before the next event or
 * where it is needed at once. It may replace the widget that gets the focus. A warning of GTK ends the test.
 */
#include "editor-gtk/kit/left.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

static GtkWidget *window, *box, *first, *second;
static int noted, done, freed;
static bool in_leave, was_in_leave;

static gpointer note(GtkWidget *widget, gpointer data)
{
	in_leave = true;
	noted++;
	return data ? g_object_ref(widget) : NULL;
}

static void renew(void);

static void then(gpointer widget)
{
	(void)widget;
	was_in_leave |= in_leave;
	done++;
	renew();
}

static void gone(gpointer widget)
{
	freed++;
	g_object_unref(widget);
}

/* As a table whose rows are made anew by an edit. */
static void renew(void)
{
	GtkWidget *child;

	while ((child = gtk_widget_get_first_child(box)) != NULL)
		gtk_box_remove(GTK_BOX(box), child);
	first = gtk_entry_new();
	second = gtk_entry_new();
	gtk_box_append(GTK_BOX(box), first);
	gtk_box_append(GTK_BOX(box), second);
	left_connect(first, note, then, gone, window);
}

static void leave(void)
{
	done = freed = noted = 0;
	WAIT(gtk_widget_grab_focus(first));
	in_leave = true;
	gtk_widget_grab_focus(second);
	in_leave = false;
}

static gboolean event(gpointer order)
{
	*(int *)order = done;
	return G_SOURCE_REMOVE;
}

static void test_soon(void)
{
	int order = -1;

	leave();
	CHECK(noted == 1);
	CHECK(done == 0);
	/* As an event would come. */
	g_idle_add_full(G_PRIORITY_DEFAULT, event, &order, NULL);
	CHECK_SOON(order >= 0);
	CHECK(order == 1);
	CHECK(freed == 1);
	CHECK(!was_in_leave);
}

static void test_now(void)
{
	leave();
	CHECK(done == 0);
	left_now();
	CHECK(done == 1);
	CHECK(freed == 1);
	turn(20);
	left_now();
	CHECK_AS(done == 1, "it is done once");
}

/* Nothing was typed. */
static void test_nothing(void)
{
	GtkWidget *entry = gtk_entry_new();

	gtk_window_set_focus(GTK_WINDOW(window), NULL);
	left_now();
	left_connect(entry, note, then, gone, NULL);
	gtk_box_append(GTK_BOX(box), entry);
	done = noted = 0;
	gtk_widget_grab_focus(entry);
	gtk_widget_grab_focus(second);
	turn(20);
	CHECK(noted > 0);
	CHECK(done == 0);
}

/* The widget goes with its window before it is done. */
static void test_gone(void)
{
	leave();
	gtk_window_set_child(GTK_WINDOW(window), NULL);
	CHECK_SOON(done == 1 && freed == 1);
}

int main(void)
{
	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	window = gtk_window_new();
	box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	g_object_ref_sink(box);
	gtk_window_set_child(GTK_WINDOW(window), box);
	renew();
	screen_show(window);
	test_soon();
	test_now();
	test_nothing();
	test_gone();
	g_object_unref(box);
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}

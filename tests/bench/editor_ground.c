/* SPDX-License-Identifier: MIT
 *
 * editor_ground - see editor_ground.h.
 */
#include "tests/bench/editor_ground.h"

#include <stdbool.h>

G_DECLARE_FINAL_TYPE(BenchGround, bench_ground, BENCH, GROUND, GtkWidget)

struct _BenchGround {
	GtkWidget parent_instance;
	bool other;
};

G_DEFINE_FINAL_TYPE(BenchGround, bench_ground, GTK_TYPE_WIDGET)

static void bench_ground_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	static const GdkRGBA colors[] = { { 1, 1, 1, 1 }, { 0.9f, 0.9f, 0.9f, 1 } };

	gtk_snapshot_append_color(snapshot, &colors[BENCH_GROUND(widget)->other],
		&GRAPHENE_RECT_INIT(0, 0, (float)gtk_widget_get_width(widget),
				    (float)gtk_widget_get_height(widget)));
}

static void bench_ground_class_init(BenchGroundClass *class)
{
	GTK_WIDGET_CLASS(class)->snapshot = bench_ground_snapshot;
}

static void bench_ground_init(BenchGround *ground)
{
	(void)ground;
}

GtkWidget *ground_window(int width, int height)
{
	GtkWidget *window = gtk_window_new();
	GtkWidget *ground = g_object_new(bench_ground_get_type(), NULL);

	gtk_widget_set_size_request(ground, width, height);
	gtk_widget_set_halign(ground, GTK_ALIGN_START);
	gtk_widget_set_valign(ground, GTK_ALIGN_START);
	gtk_window_set_child(GTK_WINDOW(window), ground);
	gtk_window_present(GTK_WINDOW(window));
	return window;
}

void ground_change(GtkWidget *window)
{
	GtkWidget *ground = gtk_window_get_child(GTK_WINDOW(window));

	BENCH_GROUND(ground)->other = !BENCH_GROUND(ground)->other;
	gtk_widget_queue_draw(ground);
}

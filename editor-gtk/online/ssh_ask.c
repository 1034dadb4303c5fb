/* SPDX-License-Identifier: MIT
 *
 * ssh_ask - see ssh_ask.h. Question and answer are one text each; the end of the stream ends them.
 * An answer begins with `+`; without an answer nothing comes.
 */
#include "editor-gtk/online/ssh_ask.h"

#include <gio/gio.h>
#include <gio/gunixsocketaddress.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <unistd.h>

#define PLACE "RUNGBOARD_ASK"  /* variable with the name of the socket. It has no file, so nothing
				  stays when the editor is killed               */
#define MOST  4096             /* bytes of a question or an answer              */

struct ssh_ask {
	void (*asks)(gpointer data, const char *question, bool yes_no);
	gpointer data;
	GSocketService *service;
	GCancellable *cancel;
	GSocketConnection *asking;     /* whose question waits; NULL: none     */
	char *name;
	char question[MOST];
	gsize len;
};

/* ---- in the editor ---- */

static void read_on(struct ssh_ask *ask);

static void part_read(GObject *stream, GAsyncResult *result, gpointer data)
{
	GError *error = NULL;
	const gssize got = g_input_stream_read_finish(G_INPUT_STREAM(stream), result, &error);
	struct ssh_ask *ask = data;
	char *text;

	if (g_error_matches(error, G_IO_ERROR, G_IO_ERROR_CANCELLED)) {
		g_error_free(error);
		return; /* @data is gone */
	}
	g_clear_error(&error);
	if (got > 0) {
		ask->len += (gsize)got;
		if (ask->len < MOST - 1) {
			read_on(ask);
			return;
		}
	}
	text = g_utf8_make_valid(ask->question, (gssize)ask->len);
	ask->asks(ask->data, text, strstr(text, "(yes/no") != NULL);
	g_free(text);
}

static void read_on(struct ssh_ask *ask)
{
	g_input_stream_read_async(g_io_stream_get_input_stream(G_IO_STREAM(ask->asking)),
				  ask->question + ask->len, MOST - 1 - ask->len,
				  G_PRIORITY_DEFAULT, ask->cancel, part_read, ask);
}

/* Any user could know the name of the socket. */
static bool is_mine(GSocketConnection *connection)
{
	GCredentials *who = g_socket_get_credentials(g_socket_connection_get_socket(connection),
						     NULL);
	const bool mine = who && g_credentials_get_unix_user(who, NULL) == getuid();

	g_clear_object(&who);
	return mine;
}

/* One question at a time, and only of this user. */
static gboolean incoming(GSocketService *service, GSocketConnection *connection, GObject *source,
			 struct ssh_ask *ask)
{
	(void)service;
	(void)source;
	if (!ask->asking && is_mine(connection)) {
		ask->asking = g_object_ref(connection);
		ask->len = 0;
		read_on(ask);
	}
	return TRUE;
}

void ssh_ask_answer(struct ssh_ask *ask, const char *answer)
{
	GSocketConnection *to = g_steal_pointer(&ask->asking);
	GOutputStream *out = to ? g_io_stream_get_output_stream(G_IO_STREAM(to)) : NULL;

	if (out && answer && g_output_stream_write_all(out, "+", 1, NULL, NULL, NULL))
		g_output_stream_write_all(out, answer, strlen(answer), NULL, NULL, NULL);
	if (to)
		g_io_stream_close(G_IO_STREAM(to), NULL, NULL);
	g_clear_object(&to);
}

char **ssh_ask_environment(const struct ssh_ask *ask)
{
	char **environment = g_get_environ(), *self = g_file_read_link("/proc/self/exe", NULL);

	environment = g_environ_setenv(environment, PLACE, ask->name, TRUE);
	environment = g_environ_setenv(environment, "SSH_ASKPASS", self ? self : "", TRUE);
	environment = g_environ_setenv(environment, "SSH_ASKPASS_REQUIRE", "force", TRUE);
	/* What ssh says is read here. */
	environment = g_environ_setenv(environment, "LC_ALL", "C", TRUE);
	g_free(self);
	return environment;
}

static GSocketAddress *address_of(const char *name)
{
	return g_unix_socket_address_new_with_type(name, -1, G_UNIX_SOCKET_ADDRESS_ABSTRACT);
}

/* Nobody else has it. Caller frees. */
static char *new_name(void)
{
	char *random = g_uuid_string_random(), *name = g_strdup_printf("rungboard-ask-%s", random);

	g_free(random);
	return name;
}

struct ssh_ask *ssh_ask_new(void (*asks)(gpointer data, const char *question, bool yes_no),
			    gpointer data, GError **error)
{
	struct ssh_ask *ask = g_new0(struct ssh_ask, 1);
	GSocketAddress *address;
	bool good;

	ask->asks = asks;
	ask->data = data;
	ask->cancel = g_cancellable_new();
	ask->service = g_socket_service_new();
	ask->name = new_name();
	address = address_of(ask->name);
	good = g_socket_listener_add_address(G_SOCKET_LISTENER(ask->service), address,
		G_SOCKET_TYPE_STREAM, G_SOCKET_PROTOCOL_DEFAULT, NULL, NULL, error);
	g_object_unref(address);
	if (!good) {
		ssh_ask_free(ask);
		return NULL;
	}
	g_signal_connect(ask->service, "incoming", G_CALLBACK(incoming), ask);
	return ask;
}

void ssh_ask_free(struct ssh_ask *ask)
{
	if (!ask)
		return;
	g_cancellable_cancel(ask->cancel);
	g_socket_service_stop(ask->service);
	g_signal_handlers_disconnect_by_data(ask->service, ask);
	ssh_ask_answer(ask, NULL);
	g_socket_listener_close(G_SOCKET_LISTENER(ask->service));
	g_object_unref(ask->service);
	g_object_unref(ask->cancel);
	g_free(ask->name);
	g_free(ask);
}

/* ---- as SSH_ASKPASS ---- */

bool ssh_ask_is_main(void)
{
	return g_getenv(PLACE) != NULL;
}

int ssh_ask_main(int argc, char **argv)
{
	GSocketAddress *address = address_of(g_getenv(PLACE));
	GSocketClient *client = g_socket_client_new();
	GSocketConnection *to;
	char answer[MOST];
	gsize len = 0;
	bool good = false;

	prctl(PR_SET_DUMPABLE, 0); /* no core has the answer */
	to = g_socket_client_connect(client, G_SOCKET_CONNECTABLE(address), NULL, NULL);
	if (to && is_mine(to) && argc > 1 &&
	    g_output_stream_write_all(g_io_stream_get_output_stream(G_IO_STREAM(to)), argv[1],
				      strlen(argv[1]), NULL, NULL, NULL) &&
	    g_socket_shutdown(g_socket_connection_get_socket(to), FALSE, TRUE, NULL))
		good = g_input_stream_read_all(g_io_stream_get_input_stream(G_IO_STREAM(to)),
					       answer, sizeof(answer), &len, NULL, NULL) &&
		       len && answer[0] == '+';
	if (good) {
		fwrite(answer + 1, 1, len - 1, stdout);
		fputc('\n', stdout);
		fflush(stdout);
	}
	memset(answer, 0, sizeof(answer));
	g_clear_object(&to);
	g_object_unref(client);
	g_object_unref(address);
	return good ? 0 : 1;
}

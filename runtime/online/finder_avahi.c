/* SPDX-License-Identifier: MIT
 *
 * finder_avahi - asks avahi-daemon, through its library. A board is announced once for each
 * network that reaches it; the list has it once.
 */
#include "online/finder.h"
#include "online/stream.h"

#include <avahi-client/client.h>
#include <avahi-client/lookup.h>
#include <avahi-common/error.h>
#include <avahi-common/malloc.h>
#include <avahi-common/simple-watch.h>

#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define EVENTS_AT_ONCE 32

/* One announcement. */
struct heard {
	struct found_board board;
	char service[64];
	AvahiIfIndex interface;
	AvahiProtocol protocol;
};

struct finder {
	AvahiSimplePoll *poll;
	AvahiClient *client;
	AvahiServiceBrowser *browser;
	struct heard heard[FINDER_MOST]; /* by name                           */
	int count;
	int asked;             /* addresses that have not come yet            */
	bool all, changed;
	const char *failed;
};

static bool is_same(const struct heard *heard, const char *service, AvahiIfIndex interface,
		    AvahiProtocol protocol)
{
	return heard->interface == interface && heard->protocol == protocol &&
	       strcmp(heard->service, service) == 0;
}

static void forget(struct finder *finder, const char *service, AvahiIfIndex interface,
		   AvahiProtocol protocol)
{
	for (int i = 0; i < finder->count; i++) {
		if (!is_same(&finder->heard[i], service, interface, protocol))
			continue;
		finder->count--;
		memmove(&finder->heard[i], &finder->heard[i + 1],
			(size_t)(finder->count - i) * sizeof(finder->heard[0]));
		finder->changed = true;
		return;
	}
}

/* A new place in the list, by name. NULL: it is full. */
static struct heard *add(struct finder *finder, const char *service)
{
	int at = finder->count;

	if (at == FINDER_MOST)
		return NULL;
	while (at && strcmp(finder->heard[at - 1].service, service) > 0)
		at--;
	memmove(&finder->heard[at + 1], &finder->heard[at],
		(size_t)(finder->count - at) * sizeof(finder->heard[0]));
	memset(&finder->heard[at], 0, sizeof(finder->heard[at]));
	finder->count++;
	finder->changed = true;
	return &finder->heard[at];
}

/* A record such as `version=0.1.0`. */
static void take_record(AvahiStringList *records, const char *key, char *out, int size)
{
	AvahiStringList *found = avahi_string_list_find(records, key);
	const size_t skip = strlen(key) + 1;
	const char *text = found ? (const char *)avahi_string_list_get_text(found) : NULL;

	if (found && avahi_string_list_get_size(found) > skip)
		finder_text(out, size, text + skip,
			    (int)(avahi_string_list_get_size(found) - skip));
}

/* The name of a host becomes an argument of ssh. */
static bool is_host(const char *host)
{
	return strlen(host) < sizeof(((struct found_board *)0)->where) && !strchr(host, '@') &&
	       stream_is_host(host);
}

static void resolved(AvahiServiceResolver *resolver, AvahiIfIndex interface,
		     AvahiProtocol protocol, AvahiResolverEvent event, const char *name,
		     const char *type, const char *domain, const char *host,
		     const AvahiAddress *address, uint16_t port, AvahiStringList *records,
		     AvahiLookupResultFlags flags, void *context)
{
	struct finder *finder = context;
	struct heard *heard = NULL;
	char service[64];

	(void)type;
	(void)domain;
	(void)address;
	(void)flags;
	finder->asked--;
	finder_text(service, sizeof(service), name, (int)strlen(name));
	if (event == AVAHI_RESOLVER_FOUND && is_host(host))
		heard = add(finder, service);
	if (heard) {
		memcpy(heard->service, service, sizeof(service));
		memcpy(heard->board.name, service, sizeof(service));
		take_record(records, "board", heard->board.name, sizeof(heard->board.name));
		take_record(records, "version", heard->board.version,
			    sizeof(heard->board.version));
		memcpy(heard->board.where, host, strlen(host));
		heard->board.port = port;
		heard->interface = interface;
		heard->protocol = protocol;
	}
	avahi_service_resolver_free(resolver);
}

static void browsed(AvahiServiceBrowser *browser, AvahiIfIndex interface,
		    AvahiProtocol protocol, AvahiBrowserEvent event, const char *name,
		    const char *type, const char *domain, AvahiLookupResultFlags flags,
		    void *context)
{
	struct finder *finder = context;
	char service[64];

	(void)browser;
	(void)flags;
	switch (event) {
	case AVAHI_BROWSER_NEW:
		if (avahi_service_resolver_new(finder->client, interface, protocol, name, type,
					       domain, AVAHI_PROTO_UNSPEC, 0, resolved, finder))
			finder->asked++;
		break;
	case AVAHI_BROWSER_REMOVE:
		finder_text(service, sizeof(service), name, (int)strlen(name));
		forget(finder, service, interface, protocol);
		break;
	case AVAHI_BROWSER_ALL_FOR_NOW:
		finder->all = true;
		break;
	case AVAHI_BROWSER_FAILURE:
		finder->failed = "Avahi cannot look for boards";
		break;
	case AVAHI_BROWSER_CACHE_EXHAUSTED:
		break;
	}
}

static void client_changed(AvahiClient *client, AvahiClientState state, void *context)
{
	struct finder *finder = context;

	(void)client;
	if (state == AVAHI_CLIENT_FAILURE)
		finder->failed = "Avahi has ended";
}

struct finder *finder_open(const char **why)
{
	struct finder *finder = calloc(1, sizeof(*finder));
	int error = AVAHI_ERR_NO_MEMORY;

	if (finder)
		finder->poll = avahi_simple_poll_new();
	if (finder && finder->poll)
		finder->client = avahi_client_new(avahi_simple_poll_get(finder->poll), 0,
						  client_changed, finder, &error);
	if (finder && finder->client) {
		finder->browser = avahi_service_browser_new(finder->client, AVAHI_IF_UNSPEC,
							    AVAHI_PROTO_UNSPEC, FINDER_SERVICE,
							    NULL, 0, browsed, finder);
		error = avahi_client_errno(finder->client);
	}
	if (finder && finder->browser)
		return finder;
	*why = error == AVAHI_ERR_NO_DAEMON || error == AVAHI_ERR_DBUS_ERROR ?
	       "Avahi does not run here; install and start avahi-daemon" : avahi_strerror(error);
	finder_close(finder);
	return NULL;
}

static int64_t now_ms(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * INT64_C(1000) + now.tv_nsec / 1000000;
}

bool finder_wait(struct finder *finder, int ms)
{
	const int64_t until = now_ms() + ms;
	const bool was_settled = finder_settled(finder);
	int64_t left = ms;
	bool changed;

	/* One step takes one event: those that are there are taken, too. */
	for (int i = 0; !finder->failed && (left > 0 || i < EVENTS_AT_ONCE); i++) {
		if (avahi_simple_poll_iterate(finder->poll, left > 0 ? (int)left : 0) != 0)
			finder->failed = "Avahi has ended";
		left = until - now_ms();
		if (left <= 0 && ms > 0)
			break;
		if (ms > 0 && (finder->changed || finder_settled(finder) != was_settled))
			break;
	}
	changed = finder->changed;
	finder->changed = false;
	return changed;
}

bool finder_settled(const struct finder *finder)
{
	return finder->failed || (finder->all && !finder->asked);
}

const char *finder_failed(const struct finder *finder)
{
	return finder->failed;
}

/* Whether the announcement before this one is of the same board. */
static bool is_again(const struct finder *finder, int i)
{
	return i && strcmp(finder->heard[i - 1].service, finder->heard[i].service) == 0;
}

int finder_count(const struct finder *finder)
{
	int count = 0;

	for (int i = 0; i < finder->count; i++)
		count += !is_again(finder, i);
	return count;
}

const struct found_board *finder_board(const struct finder *finder, int index)
{
	for (int i = 0; i < finder->count; i++)
		if (!is_again(finder, i) && index-- == 0)
			return &finder->heard[i].board;
	return NULL;
}

void finder_close(struct finder *finder)
{
	if (!finder)
		return;
	if (finder->client)
		avahi_client_free(finder->client);
	if (finder->poll)
		avahi_simple_poll_free(finder->poll);
	free(finder);
}

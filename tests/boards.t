#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# boards.t - tests `ladder boards` with a real avahi-daemon, in namespaces of its own: no
# announcement leaves this machine. It publishes packaging/ladder.service, and a board whose
# records are hostile.
use strict;
use warnings;
use utf8;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use JSON::PP;
use Test::More;
use Time::HiRes qw(sleep);
use lib abs_path(dirname(__FILE__));
use Limit;

my $build = abs_path($ENV{BUILD} // 'build');
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
chdir dirname(__FILE__) . '/..' or die;
$ENV{PATH} = "$ENV{PATH}:/usr/sbin:/sbin";

if (!$ENV{BOARDS_INSIDE}) {
	for my $tool (qw(unshare ip dbus-daemon avahi-daemon avahi-publish)) {
		plan skip_all => "no $tool: apt-get install avahi-daemon avahi-utils iproute2 dbus-daemon"
			if system("command -v $tool >/dev/null 2>&1");
	}
	my @alone = ('unshare', '--fork', '--kill-child', $> ? '-r' : (), '-m', '-n', '-p', '--mount-proc');
	plan skip_all => 'no namespaces on this machine' if system("@alone true 2>/dev/null");
	$ENV{BOARDS_INSIDE} = 1;
	exec @alone, $^X, abs_path("tests/boards.t") or die;
}

sub put { my ($name, $text) = @_; open my $f, '>:raw', $name or die "$name: $!"; utf8::encode($text); print $f $text; close $f }
sub get { my ($name) = @_; open my $f, '<:utf8', $name or return ''; local $/; return <$f> // '' }
sub start {
	my ($log, @command) = @_;
	my $pid = fork // die;
	if (!$pid) {
		open STDIN, '<', '/dev/null'; open STDOUT, '>', $log; open STDERR, '>&', *STDOUT;
		exec @command or POSIX::_exit(127);
	}
	return $pid;
}
sub boards { # exit status, output, messages
	my (@words) = @_;
	my $status = system "$ladder boards @words >/run/out 2>/run/err";
	return ($status >> 8, get('/run/out'), get('/run/err'));
}

# ---- a machine of its own ----
system('mount -t tmpfs tmpfs /run') == 0 or die;
mkdir $_ for '/run/dbus', '/run/avahi-daemon', '/run/services';
system 'ip link set lo up multicast on';
system 'ip link add desk0 type dummy 2>/dev/null && ip addr add 10.9.9.9/24 dev desk0 && ip link set desk0 up';

my ($status, $out, $err) = boards();
is($status, 2, 'without Avahi: exit 2');
like($err, qr/^ladder: error LD023: boards cannot be found: Avahi does not run here/m, 'it says what to do');
($status, $out, $err) = boards('--json');
ok(eval { decode_json($out); 1 }, 'and JSON is still JSON');

put('/run/bus.conf', <<'END');
<busconfig><type>system</type><listen>unix:path=/run/dbus/system_bus_socket</listen><auth>EXTERNAL</auth>
<policy context="default"><allow send_destination="*" eavesdrop="true"/><allow eavesdrop="true"/><allow own="*"/></policy></busconfig>
END
start('/run/bus.log', 'dbus-daemon', '--config-file=/run/bus.conf', '--nofork');
ok(until_true(sub { -S '/run/dbus/system_bus_socket' }), 'a bus of its own');
put('/run/avahi.conf', "[server]\nhost-name=garage\nenable-dbus=yes\n");
my $service = get('packaging/ladder.service');
my ($version) = get('runtime/engine/base/version.h') =~ /LADDER_VERSION "(.*)"/;
put('/run/services/ladder.service', $service =~ s/\@VERSION\@/$version/r);
SKIP: {
	skip 'Avahi looks for services in another folder', 12
		if system('mount --bind /run/services /etc/avahi/services 2>/dev/null');
	my $daemon = start('/run/avahi.log', 'avahi-daemon', '--no-drop-root', '--no-rlimits', '--no-chroot', '--no-proc-title', '-f', '/run/avahi.conf');
	ok(until_true(sub { get('/run/avahi.log') =~ /successfully established/ }), 'Avahi takes packaging/ladder.service')
		or diag(get('/run/avahi.log'));
	ok(until_true(sub { ($status, $out, $err) = boards(); $out =~ /^garage/m }), 'the board is found');
	like($out, qr/^garage\.local\tgarage\t\Q$version\E$/m, 'a line: where, name, version');
	is($status, 0, 'exit 0');
	is($err, '', 'without a message');
	is(() = $out =~ /^garage/mg, 1, 'once, whatever the number of networks');

	start('/run/publish.log', 'avahi-publish', '-s', "Evil\e[31m", '_ladder._tcp', '2222', "board=T\x{fc}r\a" =~ s/\x{fc}/\xc3\xbc/r, 'version=' . 'v' x 200);
	ok(until_true(sub { ($status, $out, $err) = boards(); $out =~ /2222/ }), 'another one comes');
	like($out, qr/^garage\.local\tTür\?\tv{31}\tport 2222$/m, 'no control character of it is printed, and long texts are cut');
	($status, $out) = boards('--json');
	my $list = decode_json(do { my $bytes = $out; utf8::encode($bytes); $bytes });
	is_deeply([map { $_->{board} } grep { $_->{port} } @$list], ['Tür?', 'garage'], 'JSON has both');
	is_deeply([sort keys %{$list->[0]}], [qw(board port version where)], 'with their fields');
	($status) = boards('--time', 'soon');
	is($status, 2, 'a wrong time is wrong usage');
	kill 'TERM', $daemon;
	waitpid $daemon, 0;
	($status) = boards();
	is($status, 2, 'when Avahi has gone, it says so');
}
done_testing();

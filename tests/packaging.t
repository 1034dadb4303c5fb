#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# packaging.t - what a package puts on a board, as far as it can be tested without building one
# (`make check-deb` does that): the sandbox of the unit, a service without a program, the offered
# part of sshd's configuration, the version.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;

my $build = abs_path($ENV{BUILD} // 'build');
chdir dirname(__FILE__) . '/..' or die;
my $dir = tempdir(CLEANUP => 1);
sub get { my ($name) = @_; open my $f, '<', $name or return ''; local $/; return <$f> // '' }
sub has { my ($tool) = @_; return !system "command -v $tool >/dev/null 2>&1" }

my $unit = get('packaging/ladderd.service');
SKIP: {
	skip 'no systemd-analyze', 1 unless has('systemd-analyze');
	my $said = `systemd-analyze security --offline=true packaging/ladderd.service 2>&1`;
	my ($exposure) = $said =~ /exposure level.*?: ([\d.]+)/;
	skip 'systemd-analyze cannot look at a file here', 1 unless defined $exposure;
	ok($exposure <= 1.5, "the unit is exposed by $exposure, at most 1.5");
}
is_deeply([$unit =~ /^RestrictAddressFamilies=(.*)$/mg], ['AF_UNIX'], 'sockets of this machine only');
# Libraries may be executed, nothing else: also a libgpiod that was built on the board.
is_deeply([$unit =~ /^NoExecPaths=(.*)\n/mg, map { split } $unit =~ /^ExecPaths=(.*)$/mg],
	[qw(/ /usr/bin/ladderd -/usr/lib -/usr/lib64 -/usr/local/lib -/lib -/lib64 -/bin/kill -/usr/bin/kill)], 'what may be executed');
like($unit, qr/^$_$/m, $_) for 'PrivateNetwork=yes', 'DynamicUser=yes', 'CapabilityBoundingSet=', 'NoNewPrivileges=yes', 'DevicePolicy=closed';

# The unit without /etc/ladder/active: FILE and MAP are empty.
my $pid = fork // die;
if (!$pid) {
	open STDOUT, '>', "$dir/out"; open STDERR, '>&', *STDOUT;
	exec "$build/ladderd", '', '--io', '', '--link', "$dir/link", '--slots', $dir or die;
}
for (1 .. 600) { last if -S "$dir/link" || waitpid($pid, 1) == $pid; select undef, undef, undef, 0.05 }
ok(-S "$dir/link", 'without a program the service waits for one') or diag(get("$dir/out"));
like(get("$dir/out"), qr/no program yet: STOP/, 'in STOP');
kill 'TERM', $pid;
waitpid $pid, 0;
is(system("$build/ladderd '' --io '' >$dir/out 2>&1") >> 8, 2, 'without slots that is wrong usage');
like(get("$dir/out"), qr/FILE is missing/, 'and says so');

my ($version) = get('runtime/engine/base/version.h') =~ /LADDER_VERSION "(.*)"/;
like(get('packaging/debian/changelog'), qr/^rungboard \(\Q$version\E\) /, 'the package has the version of the programs');
SKIP: {
	skip 'no shellcheck', 1 unless has('shellcheck');
	is(`shellcheck -s sh packaging/deb.sh packaging/debian/rungboard-runtime.p* 2>&1`, '', 'shellcheck has nothing to say about the scripts');
}
done_testing();

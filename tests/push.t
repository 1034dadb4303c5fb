#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# push.t - tests `ladder push` with a folder as the board: a real sshd on loopback with its
# own keys (without sshd, a stand-in that runs the remote command here), a real ladderd on
# simulated pins under ladderd-run, and connections that are cut at each call. A push that
# the board refuses or that is incomplete must not change the running program. With --folder
# it copies files; the last part is about pushes through the link.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use IO::Socket::INET;
use POSIX ();
use Test::More;
use Time::HiRes qw(sleep);
use lib dirname(abs_path(__FILE__));
use Limit;

my $build = abs_path($ENV{BUILD} // 'build');
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $run_script = abs_path('packaging/ladderd-run');
my $dir = tempdir(CLEANUP => 1);
my $bin = "$dir/board/bin";
my $etc = "$dir/board/etc"; # in place of /etc/ladder
my (@started, $made_run_sshd);
@Limit::show = map { "$dir/$_" } qw(log .out .err);
chdir $dir or die;

sub put { my ($name, $text, $mode) = @_; open my $f, '>:raw', $name or die "$name: $!"; print $f $text; close $f; chmod $mode, $name if $mode }
sub get { my ($name) = @_; open my $f, '<:raw', $name or return ''; local $/; my $text = <$f>; close $f; return $text // '' }

sub start {
	my (@command) = @_;
	my $pid = fork // die "fork: $!";
	if (!$pid) {
		open STDIN, '<', '/dev/null';
		open STDOUT, '>>', "$dir/log"; open STDERR, '>>', "$dir/log";
		exec @command or POSIX::_exit(127);
	}
	push @started, $pid;
	return $pid;
}

END {
	my $status = $?;
	for my $pid (reverse @started) { kill 'TERM', $pid; waitpid $pid, 0 }
	if (my $pid = $dir && pid()) { kill 'TERM', $pid }
	rmdir '/run/sshd' if $made_run_sshd;
	chdir '/';
	$? = $status;
}

# Runs `ladder push`. Returns exit status, standard output, standard error.
sub push_it {
	my ($ssh, @args) = @_;
	my $pid = fork // die;
	if (!$pid) {
		open STDIN, '<', '/dev/null'; open STDOUT, '>', '.out'; open STDERR, '>', '.err';
		exec $ladder, 'push', '--ssh', $ssh, @args or die;
	}
	return (finish($pid), get('.out'), get('.err'));
}
sub is_push {
	my ($want, $what, $ssh, @args) = @_;
	my ($status, $out, $err) = push_it($ssh, @args);
	is($status, $want, "$what: exit $want") or diag("$out$err" . get('log'));
	return ($out, $err);
}

# ---- programs and maps ----
sub program {
	my ($name, $contact) = @_;
	return "RUNGBOARD 1\nPROJECT \"$name\"\n\nVAR\n  Start AT %IX0.0 : BOOL;\n  Lamp  AT %QX0.0 : BOOL;\nEND_VAR\n\n" .
		"PROGRAM Main LD\nRUNG\n  | $contact Start | COIL Lamp |\nEND_PROGRAM\n";
}
put('one.rung', program('One', 'NO'));
put('two.rung', program('Two', 'NC'));
put('bad.rung', program('Bad', 'NO') =~ s/Lamp \|/Lamb |/r);
put('desk.io', "BOARD \"desk\"\n%IX0.0 sim\n%QX0.0 sim safe=0\n");
put('bad.io', "BOARD \"x\"\n%IX0.0 nonsense\n");
put('other.io', "BOARD \"other\"\n%IX0.0 gpio line=NO_BOARD_HAS_THIS\n%QX0.0 sim\n");
sub identity {
	my ($file) = @_;
	my ($sha) = `\Q$ladder\E code \Q$file\E 2>/dev/null` =~ /^identity +(\w+)/m;
	return $sha // "no identity of $file";
}

# ---- the board ----
mkdir $_ for "$dir/board", $bin, $etc, "$dir/board/run";
symlink "$build/ladderd", "$bin/ladderd" or die;
symlink $run_script, "$bin/ladderd-run" or die;
# A second of the board is shorter here: until ladderd has answered, or a third. Where a ladderd must be seen to stay, it is whole.
put("$bin/sleep", <<"END", 0755);
#!/bin/sh
[ ! -e $dir/slowly ] || exec /bin/sleep "\$1"
grep -q status /proc/\$PPID/cmdline || exec /bin/sleep 0.3
for tenth in 1 2 3 4 5 6 7 8 9 10; do
	/bin/sleep 0.1
	[ ! -s $dir/board/run/ladderd.status ] || exec /bin/sleep 0.1
done
END
put("$dir/board/default", "LADDERD_OPTIONS=\"--period 10ms\"\n");
my $board_env = "LADDERD_FOLDER=$etc LADDERD_DEFAULT=$dir/board/default LADDERD_RUN=$dir/board/run";
put("$etc/service", "#!/bin/sh\nexport $board_env\nexec ladderd-run \"\$@\"\n", 0755);
sub pid { my ($pid) = get("$dir/board/run/ladderd.pid") =~ /^(\d+)/; return $pid && get("/proc/$pid/comm") eq "ladderd\n" ? $pid : 0 }
sub active { my ($file) = get("$etc/active") =~ /^LADDERD_FILE=(.*)/m; return $file // '' }
sub folders { my @all = glob "$etc/push-*"; return scalar @all }
sub ask { my $text = `$board_env PATH=$bin:\$PATH ladderd-run status`; return $text }

# A stand-in for ssh: runs its last word here, as a board does.
put('local-ssh', "#!/bin/sh\nfor last; do :; done\nPATH=$bin:\$PATH\nexport PATH\nexec sh -c \"\$last\"\n", 0755);

# A real sshd, if it is installed and accepts us.
my ($ssh, $no_sshd) = ("$dir/local-ssh", 'apt-get install openssh-server');
my ($port, $options);
sub free_port { my $s = IO::Socket::INET->new(Listen => 1, LocalAddr => '127.0.0.1') or return 0; return $s->sockport }
my $user = getpwuid $>;
my ($sshd) = grep { -x } '/usr/sbin/sshd', '/usr/bin/sshd', '/usr/local/sbin/sshd';
if ($sshd && !system 'ssh-keygen -q -t ed25519 -N "" -f host && ssh-keygen -q -t ed25519 -N "" -f key') {
	$port = free_port();
	put('sshd_config', join "\n", "Port $port", 'ListenAddress 127.0.0.1', "HostKey $dir/host", "AuthorizedKeysFile $dir/key.pub",
	    "PidFile $dir/sshd.pid", 'UsePAM no', 'StrictModes no', 'PasswordAuthentication no', 'KbdInteractiveAuthentication no',
	    'PermitRootLogin yes', "SetEnv PATH=$bin:/usr/local/bin:/usr/bin:/bin", '');
	put('known', "[127.0.0.1]:$port " . get('host.pub'));
	$made_run_sshd = $> == 0 && mkdir '/run/sshd', 0755;
	start($sshd, '-D', '-f', "$dir/sshd_config", '-E', "$dir/sshd.log");
	$options = "-F none -i $dir/key -o BatchMode=yes -o IdentitiesOnly=yes -o IdentityAgent=none " .
		   "-o StrictHostKeyChecking=yes -o UserKnownHostsFile=$dir/known -o ConnectTimeout=20";
	for (1 .. 50) {
		last if (IO::Socket::INET->new(PeerAddr => '127.0.0.1', PeerPort => $port));
		sleep 0.1;
	}
	if (system("ssh $options -p $port $user\@127.0.0.1 true >log 2>&1") == 0) {
		($ssh, $no_sshd) = ("ssh $options -p $port", undef);
	} else {
		($no_sshd) = (get('sshd.log') . get('log')) =~ /^(.*\S)\s*\z/m;
		$no_sshd = 'sshd does not let us in: ' . ($no_sshd // '?');
	}
}
my $board = "$user\@127.0.0.1";
SKIP: {
	skip "no real ssh, a stand-in instead: $no_sshd", 1 if $no_sshd;
	pass('a real sshd answers');
}
my @to = ('--folder', $etc);

# ---- errors on this side are reported here, without a call of ssh ----
put('never', "#!/bin/sh\ntouch $dir/called\n", 0755);
my ($out, $err) = is_push(1, 'an error in the program', "$dir/never", 'bad.rung', 'desk.io', $board);
like($err, qr/^bad\.rung:\d+: rung 1 \(1,2\): error LD301: "Lamb" .*; did you mean Lamp\?$/m, 'the message of `ladder check`');
($out, $err) = is_push(1, 'an error in the map', "$dir/never", 'one.rung', 'bad.io', $board);
like($err, qr/^bad\.io:2:8: error LD503: /m, 'with its place');
put('far.io', "BOARD \"x\"\n%IX0.0 sim\n%QX512.0 sim\n");
($out, $err) = is_push(1, 'a line beyond its area', "$dir/never", 'one.rung', 'far.io', $board);
like($err, qr/^far\.io:3:1: error LD523: /m, 'the map is checked before anything is sent');
($out, $err) = is_push(1, 'errors in both', "$dir/never", 'bad.rung', 'bad.io', $board);
like($err, qr/LD301.*LD503/s, 'both errors are reported');
is_push(2, 'no such program', "$dir/never", 'nothing.rung', 'desk.io', $board);
is_push(2, 'no such map', "$dir/never", 'one.rung', 'nothing.io', $board);
for my $host ('-oProxyCommand=touch', 'pi@-oX', 'a b', 'pi@', '@x', '', 'a;b', 'a`b`', 'a$b', "a\nb", "a'b") {
	my $shown = $host =~ s/\n/\\n/r;
	($out, $err) = is_push(2, "a board called '$shown'", "$dir/never", 'one.rung', 'desk.io', '--', $host);
	like($err, qr/^ladder push: error LD007/, 'is wrong usage');
}
is_push(2, "a folder called '$_'", "$dir/never", '--folder', $_, 'one.rung', 'desk.io', $board)
	for '', '/', 'etc', '/a b', '/a;b', '/a/../b', '/a/', '/$HOME', "/a'b", '/' . 'a' x 300;
is_push(2, 'no word for ssh', '  ', 'one.rung', 'desk.io', $board);
is_push(2, 'too many words for ssh', 'ssh ' x 40, 'one.rung', 'desk.io', $board);
ok(!-e 'called', 'ssh was not called');

# ---- no connection to the board ----
($out, $err) = is_push(2, 'no ssh', "$dir/no-such-ssh", 'one.rung', 'desk.io', $board);
like($err, qr/^\Q$board\E: error LD011: .*No such file/m, 'no ssh: a message');
SKIP: {
	skip 'no real ssh', 2 if $no_sshd;
	my $closed = free_port();
	($out, $err) = is_push(2, 'nobody listens', "ssh $options -p $closed", 'one.rung', 'desk.io', $board);
	like($err, qr/^\Q$board\E: error LD011: /m, 'no connection: a message');
}

# ---- a good push, and a second and a third ----
start('sh', '-c', "while :; do $board_env PATH=$bin:\$PATH ladderd-run; sleep 0.2; done");
($out, $err) = is_push(0, 'the first push', $ssh, @to, 'one.rung', 'desk.io', $board);
like($out, qr/^state: RUN\n.*^board: desk\nprogram: \Q${\identity('one.rung')}\E$/ms, 'it shows the status of this very program');
my $first = active();
system $ladder, 'build', 'one.rung', '-o', 'one.rungc';
is(get($first), get('one.rungc'), 'the image is what `ladder build` makes');
is(get($first =~ s/program\.rungc/board.io/r), get('desk.io'), 'the map is there');
my $pid = pid();
ok($pid, 'ladderd runs');
($out, $err) = is_push(0, 'the second push', $ssh, @to, 'two.rung', 'desk.io', $board);
like($out, qr/^program: \Q${\identity('two.rung')}\E$/m, 'the second program runs');
isnt(pid(), $pid, 'in another ladderd');
isnt(active(), $first, 'from another folder');
ok(-e $first, 'the one before is kept');
put("x\$(touch called);touch called '\n.rung", program('Odd', 'NO'));
is_push(0, 'a file name for shells', $ssh, @to, "x\$(touch called);touch called '\n.rung", 'desk.io', $board);
ok(!-e 'called' && !-e "$etc/called", 'no shell reads it');
ok(!-e $first, 'the third push removes the first');
is(folders(), 2, 'no more than two are kept');

# ---- refused: nothing changes ----
sub unchanged { # what, code
	my ($what, $call) = @_;
	my ($before_pid, $before, $before_count) = (pid(), get("$etc/active"), folders());
	$call->();
	is(get("$etc/active"), $before, "$what: the old files stand");
	is(pid(), $before_pid, "$what: the old ladderd runs");
	like(ask(), qr/^state: RUN$/m, "$what: and scans");
	return folders() - $before_count;
}
put('newer', "#!/bin/sh\ncp \"\$1\" $dir/newer.rungc\nprintf '\\377' | dd of=$dir/newer.rungc bs=1 seek=8 conv=notrunc 2>/dev/null\n" .
    "shift\nexec $build/ladderd $dir/newer.rungc \"\$@\"\n", 0755);
my $left = unchanged('refused', sub {
	rename "$bin/ladderd", "$bin/ladderd.away"; symlink "$dir/newer", "$bin/ladderd";
	($out, $err) = is_push(1, 'an image the board refuses', $ssh, @to, 'one.rung', 'desk.io', $board);
	unlink "$bin/ladderd"; rename "$bin/ladderd.away", "$bin/ladderd";
});
like($err, qr/error LD6\d\d: .*^\Q$board\E: error LD013: /ms, 'what ladderd --check says, and that it was refused');
is($left, 0, 'refused: nothing is left behind');
$left = unchanged('no ladderd', sub {
	rename "$bin/ladderd", "$bin/ladderd.away";
	($out, $err) = is_push(2, 'no ladderd there', $ssh, @to, 'one.rung', 'desk.io', $board);
	rename "$bin/ladderd.away", "$bin/ladderd";
});
like($err, qr/^\Q$board\E: error LD019: .*ladderd/m, 'no ladderd: says so');
is($left, 0, 'no ladderd: nothing is left behind');
put('file', '');
unchanged('no folder', sub { ($out, $err) = is_push(2, 'no folder there', $ssh, '--folder', "$dir/file/x", 'one.rung', 'desk.io', $board) });
like($err, qr/^\Q$board\E: error LD012: /m, 'no folder: says so');

# ---- a map of another board passes --check, which opens nothing, and does not start ----
my $before = get("$etc/active");
my $runs = identity(active());
put('slowly', '');
($out, $err) = is_push(1, 'lines that are not there', $ssh, @to, 'one.rung', 'other.io', $board);
unlink 'slowly';
like($err, qr/^\Q$board\E: error LD014: .*the previous program runs again$/m, 'it went back, and says so');
is(get("$etc/active"), $before, 'the old files stand again');
like(ask(), qr/^state: RUN\n.*^program: $runs$/ms, 'the old program runs again');
is(folders(), 2, 'nothing is left behind');

# ---- the connection is cut in each call ----
put('cutting-ssh', <<'END', 0755);
#!/usr/bin/perl
# Calls $ENV{REAL_SSH}; in call $ENV{CUT_CALL} sends half and kills it, or, if
# CUT_LATE is set, sends all and kills it once the file of that name has changed.
use strict; use warnings;
local $/;
my $all = <STDIN> // '';
open my $count, '>>', $ENV{CUT_COUNT} or die; print $count 'x'; close $count;
my $cut = -s $ENV{CUT_COUNT} == $ENV{CUT_CALL};
my $late = $ENV{CUT_LATE};
sub text { open my $f, '<', $late or return ''; return <$f> // '' }
my $was = $late ? text() : '';
pipe my $in, my $out or die;
my $pid = fork // die;
if (!$pid) { open STDIN, '<&', $in; close $in; close $out; exec split(/ /, $ENV{REAL_SSH}), @ARGV or die }
close $in; $SIG{PIPE} = 'IGNORE';
syswrite $out, $cut && !$late ? substr($all, 0, length($all) / 2) : $all;
if ($cut) {
	close $out if $late;
	for (1 .. ($late ? 600 : 20)) { select undef, undef, undef, 0.05; last if $late && text() ne $was }
	kill 'KILL', $pid; waitpid $pid, 0;
	exit 255;
}
close $out; waitpid $pid, 0; exit($? & 127 ? 255 : $? >> 8);
END
put('many.rung', program('Many', 'NO') =~ s/(RUNG\n.*\n)/$1 x 2000/er);
$ENV{REAL_SSH} = $ssh;
$ENV{CUT_COUNT} = "$dir/count";
for my $call (1 .. 3) {
	unlink 'count';
	$ENV{CUT_CALL} = $call;
	unchanged("cut in call $call", sub { ($out, $err) = is_push(2, "cut in call $call", "$dir/cutting-ssh", @to, 'many.rung', 'desk.io', $board) });
	like($err, $call == 3 ? qr/^\Q$board\E: error LD015: /m : qr/^\Q$board\E: error LD011: /m, "cut in call $call: says so");
}
SKIP: {
skip 'no real ssh: killing the stand-in kills the board', 5 if $no_sshd;
unlink 'count';
$ENV{CUT_LATE} = "$etc/active";
($out, $err) = is_push(2, 'cut while it switches', "$dir/cutting-ssh", @to, 'many.rung', 'desk.io', $board);
like($err, qr/error LD015: /, 'cut while it switches: says that it is the old one or the new one');
my $many = identity('many.rung');
is(identity(active()), $many, 'cut while it switches: the new files stand, whole');
my $status = '';
for (1 .. 20) { last if ($status = ask()) =~ /^program: $many$/m; sleep 0.5 }
like($status, qr/^state: RUN\n.*^program: $many$/ms, 'cut while it switches: the new program comes up all the same');
# The script on the board ends by itself; its last step removes old folders.
for (1 .. 40) { last if folders() == 2; sleep 0.5 }
is(folders(), 2, 'what the cuts left behind goes with the next push');
}

# ---- the script itself, and systemd as it calls it ----
my $script = "$dir/script";
put('keeping-ssh', "#!/bin/sh\nfor last; do :; done\n[ \"\$last\" != 'sh -s' ] || cat >$script\n[ \"\$last\" = 'sh -s' ] || cat >/dev/null\n", 0755);
is_push(0, 'a board that says yes to everything', "$dir/keeping-ssh", '--folder', '/etc/ladder', 'one.rung', 'desk.io', $board);
like(get($script), qr{^\{\nset -- /etc/ladder push-[0-9a-f]{16} \d+ \d+\n}, 'it works in /etc/ladder');
SKIP: {
	skip 'no shellcheck: apt-get install shellcheck', 1 unless grep { -x "$_/shellcheck" } split /:/, $ENV{PATH};
	is(`shellcheck -s sh -e SC2086 $script 2>&1`, '', 'shellcheck has nothing to say about it');
}
my $text = get($script);
my @harm;
for my $at (map { int($_ * (length($text) - 2) / 40) } 0 .. 40) {
	my $cut = substr($text, 0, $at) =~ s{/etc/ladder}{$etc}r;
	my $was = join ' ', sort glob "$etc/*";
	open my $sh, '|-', 'sh -s >/dev/null 2>&1' or die; print $sh $cut; close $sh;
	push @harm, $at if $was ne join ' ', sort glob "$etc/*";
}
is("@harm", '', 'cut anywhere, it does nothing');

my $plain = "$dir/board/plain";
mkdir $plain;
put("$bin/systemctl", "#!/bin/sh\necho \"\$*\" >>$dir/systemctl.log\ncase \$* in *restart*) exit \$(cat $dir/systemctl.fails 2>/dev/null || echo 0);; esac\n", 0755);
is_push(0, 'systemd', "$dir/local-ssh", '--folder', $plain, 'one.rung', 'desk.io', $board);
my $log = get('systemctl.log');
like($log, qr/^cat ladderd\.service\nreset-failed ladderd\nrestart ladderd\nkill -s USR1 ladderd\nstatus .*ladderd\n\z/, 'systemd: its calls, in order');
put('systemctl.fails', "1\n");
$before = get("$plain/active");
($out, $err) = is_push(1, 'systemd cannot start it', "$dir/local-ssh", '--folder', $plain, 'two.rung', 'desk.io', $board);
like($err, qr/error LD014: /, 'systemd cannot start it: says so');
is(get("$plain/active"), $before, 'systemd cannot start it: the old files stand again');
mkdir "$dir/board/fresh";
is_push(1, 'nothing ran before', "$dir/local-ssh", '--folder', "$dir/board/fresh", 'two.rung', 'desk.io', $board);
ok(!-e "$dir/board/fresh/active", 'nothing ran before: nothing is named afterwards');

# ---- through the link ----
# From here on ladderd on the board has a link, and ladder-attach finds it.
sub running { # identity of the program that runs, asked as on the board itself
	my ($sha) = `cd $dir/board && $ladder board unix:link status 2>&1` =~ /^program: (\w+)/m;
	return $sha // '';
}
my $attach = "$build/tests/online/ladder-attach";
my $group = (split ' ', $))[0];
put("$dir/board/group", "ladder-eng:x:$group:\n");
mkdir "$dir/board/slots";
my $link = "--period 10ms --link $dir/board/link --groups $dir/board/group";
put("$dir/board/default", "LADDERD_OPTIONS=\"$link --slots $dir/board/slots\"\n");
is_push(0, 'files for a ladderd with a link', $ssh, @to, 'one.rung', 'desk.io', $board);
my $one = identity('one.rung');
my $two = identity('two.rung');
ok(until_true(sub { running() eq $one }), 'the layout of /etc/ladder/active runs with a link, too');

put("$bin/ladder-attach", "#!/bin/sh\ncd $dir/board && exec $attach\n", 0755);
$pid = pid();
($out, $err) = is_push(0, 'a push through the link', $ssh, 'two.rung', 'desk.io', $board);
is($err, '', 'it says nothing more');
like($out, qr/^mode: RUN\n.*^program: $two$/ms, 'it shows the status of this very program');
is(pid(), $pid, 'the same ladderd runs on');
is(running(), $two, 'and has the new program');
is_deeply([map { s{.*/}{}r } glob "$dir/board/slots/prog.*"], ['prog.A'], 'it is in a slot');
kill 'TERM', $pid;
ok(until_true(sub { pid() && pid() != $pid && running() ne '' }), 'ladderd starts again');
is(running(), $two, 'with the program of the slot: the files of /etc/ladder/active were taken over once');

put('three.rung', program('Three', 'NO') =~ s/(Lamp  AT.*\n)/$1  Pieces : INT;\n/r);
is_push(0, 'a program with a counter', $ssh, 'three.rung', 'desk.io', $board);
is(system("cd $dir/board && $ladder board unix:link force Start=1"), 0, 'an input is forced');
($out, $err) = is_push(0, 'a program without it', $ssh, 'one.rung', 'desk.io', $board);
like($out, qr/^Pieces is not in the new program; its value is lost$/m, 'what is lost is listed, without a question');
like($out, qr/^forces: 1$/m, 'the force goes on');
$pid = pid();
put('plain.io', "BOARD \"plain\"\n%IX0.0 sim\n%QX0.0 sim\n");
system "cd $dir/board && $ladder board unix:link stop";
($out, $err) = is_push(0, 'a board in STOP', $ssh, 'one.rung', 'desk.io', $board);
like($out, qr/^the board does not run; it begins again\n.*^mode: RUN$/ms, 'it runs afterwards, as after each push');
($out, $err) = is_push(0, 'another map', $ssh, 'one.rung', 'plain.io', $board);
like($out, qr/^board: plain$/m, 'its lines are exchanged while the program runs');
unlike($out, qr/begins again/, 'without a restart');
is(pid(), $pid, 'in the same process');
$before = running();
($out, $err) = is_push(1, 'lines that are not there', $ssh, 'two.rung', 'other.io', $board);
like($out, qr/^the lines of the new I\/O map need a restart; the board begins again$/m, 'only a restart shows it');
like($err, qr/^\Q$board\E: error LD014: .*the previous program runs again$/m, 'it went back, and says so');
is(running(), $before, 'the previous program runs again');
($out, $err) = is_push(1, 'an error in the program', $ssh, 'bad.rung', 'desk.io', $board);
is(running(), $before, 'an error at the desk changes nothing');

# ---- without the link: the files are copied, and one line says why ----
sub falls_back {
	my ($what, $why, $program, $reach) = @_;
	($out, $err) = is_push(0, $what, $reach // $ssh, $program, 'desk.io', $board);
	like($err, qr/^\Q$board\E: warning LD022: $why; the program is copied with ssh and started anew$/m, "$what: says why");
	is(() = $err =~ /^\Q$board\E: /mg, 1, "$what: in one line");
	return $out;
}
put('home-ssh', <<"END", 0755);
#!/bin/sh
# A board whose /etc/ladder is $etc, and whose ladder-attach is the command HOW.
for last; do :; done
PATH=$bin:\$PATH
export PATH
case \$last in
ladder-attach) exec \$HOW ;;
sh\\ -s) sed 's|/etc/ladder|$etc|' | exec sh -s ;;
*) exec sh -c "\$(printf %s "\$last" | sed 's|/etc/ladder|$etc|g')" ;;
esac
END
put('not-there', "#!/bin/sh\nexit 127\n", 0755);
put('no-daemon', "#!/bin/sh\nexit 1\n", 0755);
put('chatter', "#!/bin/sh\necho welcome to this board; cat >/dev/null\n", 0755);
put('from-tomorrow', "#!/bin/sh\nhead -c 30 >/dev/null; printf '\\012\\000\\000\\000\\001\\003\\001\\000\\004\\000\\002\\0002.'; cat >/dev/null\n", 0755);
$ENV{HOW} = "$dir/not-there";
$out = falls_back('no ladder-attach', 'the board has no ladder-attach', 'two.rung', "$dir/home-ssh");
like($out, qr/^state: RUN\n.*^program: $two$/ms, 'no ladder-attach: the program runs all the same');
ok(until_true(sub { running() eq $two }), 'no ladder-attach: newer files are used instead of the slot');
$ENV{HOW} = "$dir/no-daemon";
falls_back('no socket', 'ladderd on the board has no link', 'one.rung', "$dir/home-ssh");
$ENV{HOW} = "$dir/chatter";
falls_back('a shell that prints', 'the link of the board does not answer', 'two.rung', "$dir/home-ssh");
$ENV{HOW} = "$dir/from-tomorrow";
falls_back('another version', 'the link of the board has another version', 'one.rung', "$dir/home-ssh");
$ENV{HOW} = "$bin/ladder-attach";
put("$dir/board/default", "LADDERD_OPTIONS=\"$link\"\n");
is_push(0, 'a ladderd without slots', $ssh, @to, 'one.rung', 'desk.io', $board);
ok(until_true(sub { running() eq $one }), 'it runs');
falls_back('no slots', 'ladderd on the board has no --slots', 'two.rung', "$dir/home-ssh");
put("$dir/board/default", "LADDERD_OPTIONS=\"$link --slots $dir/board/slots\"\n");
put("$dir/board/group", "ladder-view:x:$group:\n");
is_push(0, 'a board where we may look', $ssh, @to, 'one.rung', 'desk.io', $board);
SKIP: {
	skip 'ladderd runs as this user, who may do all', 4 if $> != 0;
	falls_back('no right', 'you are not in the group ladder-eng there', 'two.rung', "$dir/home-ssh");
}
done_testing();

#define _DEFAULT_SOURCE
#include "can_bus.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/can.h>
#include <net/if.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

int64_t can_bus_clock_ns(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* ---- the embedded bus; docs/own-target.md describes its format ---- */

typedef struct {
  uint32_t magic;
  uint8_t own_echo, only_some, wanted[256];
  char node_name[66];
} hello;

typedef struct {
  uint32_t id;
  uint8_t size, flags;
  uint16_t unused;
  int64_t t_ns;
  uint8_t data[64];
} datagram;
enum { HEADER_BYTES = 16, HELLO_MAGIC = 0x31484843 }; /* "CHH1" */

static bool is_ours_alone(const char* path) {
  struct stat entry;
  return lstat(path, &entry) == 0 && S_ISDIR(entry.st_mode) && entry.st_uid == geteuid() && (entry.st_mode & 077) == 0;
}

static int open_local(const char* name) {
  struct sockaddr_un address;
  hello word;
  const char* runtime = getenv("XDG_RUNTIME_DIR");
  const int s = socket(AF_UNIX, SOCK_SEQPACKET, 0);
  int length;
  memset(&address, 0, sizeof address);
  address.sun_family = AF_UNIX;
  if (runtime != NULL && is_ours_alone(runtime))
    length = snprintf(address.sun_path, sizeof address.sun_path, "%s/canhil/%s.classic", runtime, name);
  else
    length = snprintf(address.sun_path, sizeof address.sun_path, "/tmp/canhil-uid-%u/%s.classic", (unsigned)geteuid(), name);
  if (length < 0 || (size_t)length >= sizeof address.sun_path) {
    errno = ENAMETOOLONG;
    return -1;
  }
  if (s < 0 || connect(s, (const struct sockaddr*)&address, sizeof address) != 0) return -1;
  memset(&word, 0, sizeof word);
  word.magic = HELLO_MAGIC;
  strcpy(word.node_name, "kit");
  return send(s, &word, sizeof word, MSG_NOSIGNAL) < 0 ? -1 : s;
}

/* ---- SocketCAN ---- */

static int open_can(const char* name) {
  const int on = 1, s = socket(PF_CAN, SOCK_RAW, CAN_RAW);
  struct sockaddr_can address;
  memset(&address, 0, sizeof address);
  address.can_family = AF_CAN;
  address.can_ifindex = (int)if_nametoindex(name);
  if (s < 0 || address.can_ifindex == 0) return -1;
  setsockopt(s, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  return bind(s, (const struct sockaddr*)&address, sizeof address) != 0 ? -1 : s;
}

/* ---- both kinds of bus ---- */

bool can_bus_open(can_bus* b, const char* name) {
  b->local = strncmp(name, "local:", 6) == 0;
  b->stamp_clock = b->local ? CLOCK_MONOTONIC : CLOCK_REALTIME;
  if (b->local) {
    char plain[65];
    const size_t length = strcspn(name + 6, "?"); /* settings after '?' are for the host of the bus */
    if (length == 0 || length >= sizeof plain) {
      errno = EINVAL;
      return false;
    }
    memcpy(plain, name + 6, length);
    plain[length] = 0;
    b->socket = open_local(plain);
  } else {
    b->socket = open_can(name);
  }
  return b->socket >= 0 && fcntl(b->socket, F_SETFL, O_NONBLOCK) == 0;
}

void can_bus_send(void* context, const canhil_frame* frame) {
  const can_bus* b = context;
  int attempt;
  datagram d;
  struct can_frame c;
  memset(&d, 0, sizeof d);
  memset(&c, 0, sizeof c);
  d.id = c.can_id = frame->id;
  d.size = c.can_dlc = frame->size;
  memcpy(d.data, frame->data, frame->size);
  memcpy(c.data, frame->data, frame->size);
  for (attempt = 0; attempt < 50; ++attempt) {
    struct pollfd room = {0, POLLOUT, 0};
    const ssize_t sent = b->local ? send(b->socket, &d, HEADER_BYTES + (size_t)frame->size, MSG_NOSIGNAL)
                                  : send(b->socket, &c, sizeof c, MSG_NOSIGNAL);
    if (sent >= 0 || (errno != EAGAIN && errno != ENOBUFS && errno != EINTR)) return;
    room.fd = b->socket;
    poll(&room, 1, 1);
    if (errno == ENOBUFS) usleep(1000); /* the interface's queue is full; poll() does not wait until this queue has room */
  }
}

int can_bus_receive(can_bus* b, canhil_frame* frame, int64_t* stamp_ns) {
  datagram d;
  struct can_frame c;
  union {
    char bytes[256];
    struct cmsghdr aligned;
  } control;
  struct iovec part;
  struct msghdr message;
  struct cmsghdr* one;
  ssize_t got;
  memset(&message, 0, sizeof message);
  part.iov_base = b->local ? (void*)&d : (void*)&c;
  part.iov_len = b->local ? sizeof d : sizeof c;
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.bytes;
  message.msg_controllen = sizeof control.bytes;
  got = recvmsg(b->socket, &message, 0);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  if (got <= 0) return -1;
  memset(frame, 0, sizeof *frame);
  frame->id = 0xFFFF;
  *stamp_ns = b->local ? d.t_ns : can_bus_clock_ns(CLOCK_REALTIME);
  for (one = CMSG_FIRSTHDR(&message); one != NULL; one = CMSG_NXTHDR(&message, one)) {
    struct timespec stamp;
    if (one->cmsg_level != SOL_SOCKET || one->cmsg_type != SO_TIMESTAMPNS) continue;
    memcpy(&stamp, CMSG_DATA(one), sizeof stamp);
    *stamp_ns = (int64_t)stamp.tv_sec * 1000000000 + stamp.tv_nsec;
  }
  if (b->local && d.flags == 0 && d.size <= 8 && got == (ssize_t)(HEADER_BYTES + d.size)) {
    frame->id = (uint16_t)d.id;
    frame->size = d.size;
    memcpy(frame->data, d.data, d.size);
  } else if (!b->local && (c.can_id & (CAN_EFF_FLAG | CAN_ERR_FLAG | CAN_RTR_FLAG)) == 0 && c.can_dlc <= 8) {
    frame->id = (uint16_t)c.can_id;
    frame->size = c.can_dlc;
    memcpy(frame->data, c.data, c.can_dlc);
  }
  return 1;
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A node as others write them, over another implementation of DDS (Eclipse Cyclone DDS): what Orca says to ROS 2 must be understood here.
 *
 *   ros_peer read TOPIC TYPE QOS SECONDS      prints each sample: "TIME bytes HEX"; QOS: best_effort, reliable, latched, deadline
 *   ros_peer twist TOPIC X Z SECONDS          says a Twist ten times a second from the moment when it is read, then falls silent
 *   ros_peer writers SECONDS                  prints the writers of the domain: "writer TOPIC TYPE USER_DATA GID"
 * The first line is "ready". Domain and interface are those of CYCLONEDDS_URI and ROS_DOMAIN_ID. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dds/dds.h"
#include "dds/ddsi/ddsi_serdata.h"
#include "ros_messages.h"

typedef struct {
  const char* name; /* "sensor_msgs/msg/LaserScan" */
  const dds_topic_descriptor_t* type;
} Known;

static const Known kKnown[] = {
    {"geometry_msgs/msg/PoseStamped", &geometry_msgs_msg_dds__PoseStamped__desc},
    {"geometry_msgs/msg/PoseWithCovarianceStamped", &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc},
    {"geometry_msgs/msg/Twist", &geometry_msgs_msg_dds__Twist__desc},
    {"nav_msgs/msg/OccupancyGrid", &nav_msgs_msg_dds__OccupancyGrid__desc},
    {"nav_msgs/msg/Odometry", &nav_msgs_msg_dds__Odometry__desc},
    {"nav_msgs/msg/Path", &nav_msgs_msg_dds__Path__desc},
    {"rmw_dds_common/msg/ParticipantEntitiesInfo", &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc},
    {"sensor_msgs/msg/BatteryState", &sensor_msgs_msg_dds__BatteryState__desc},
    {"sensor_msgs/msg/LaserScan", &sensor_msgs_msg_dds__LaserScan__desc},
    {"sensor_msgs/msg/Range", &sensor_msgs_msg_dds__Range__desc},
    {"tf2_msgs/msg/TFMessage", &tf2_msgs_msg_dds__TFMessage__desc},
};

static dds_entity_t g_participant;

static int fail(const char* what) {
  fprintf(stderr, "ros_peer: %s\n", what);
  return 2;
}

static double now(void) { return (double)dds_time() * 1e-9; }

static const dds_topic_descriptor_t* find(const char* name) {
  for (size_t i = 0; i < sizeof kKnown / sizeof kKnown[0]; ++i)
    if (strcmp(kKnown[i].name, name) == 0) return kKnown[i].type;
  return NULL;
}

static dds_entity_t make_topic(const char* name, const dds_topic_descriptor_t* type) {
  char full[300];
  snprintf(full, sizeof full, "%s%s", name[0] == '/' ? "rt" : "", name);
  return dds_create_topic(g_participant, type, full, NULL, NULL);
}

static dds_qos_t* make_qos(const char* kind) {
  dds_qos_t* qos = dds_create_qos();
  const int reliable = strcmp(kind, "best_effort") != 0;
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_SECS(1));
  dds_qset_durability(qos, strcmp(kind, "latched") == 0 ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  if (strcmp(kind, "deadline") == 0) dds_qset_deadline(qos, DDS_MSECS(10));
  return qos;
}

static void print_sample(struct ddsi_serdata* data) {
  const uint32_t size = ddsi_serdata_size(data);
  unsigned char* const bytes = malloc(size);
  ddsi_serdata_to_ser(data, 0, size, bytes);
  printf("%.3f bytes ", now());
  for (uint32_t i = 0; i < size; ++i) printf("%02x", bytes[i]);
  printf("\n");
  free(bytes);
}

static int run_read(const char* topic, const char* type, const char* qos_name, double seconds) {
  const dds_topic_descriptor_t* const known = find(type);
  if (known == NULL) return fail("an unknown type");
  dds_qos_t* const qos = make_qos(qos_name);
  const dds_entity_t reader = dds_create_reader(g_participant, make_topic(topic, known), qos, NULL);
  if (reader < 0) return fail(dds_strretcode(reader));
  const double end = now() + seconds;
  printf("ready\n");
  while (now() < end) {
    struct ddsi_serdata* data = NULL;
    dds_sample_info_t info;
    while (dds_takecdr(reader, &data, 1, &info, DDS_ANY_STATE) == 1) {
      if (info.valid_data) print_sample(data);
      ddsi_serdata_unref(data);
    }
    fflush(stdout);
    dds_sleepfor(DDS_MSECS(5));
  }
  return 0;
}

static dds_entity_t make_writer(const char* topic, const dds_topic_descriptor_t* type) {
  return dds_create_writer(g_participant, make_topic(topic, type), make_qos("reliable"), NULL);
}

/* Returns whether somebody reads what is written, at the latest after that time. */
static int wait_for_reader(dds_entity_t writer, double seconds) {
  dds_publication_matched_status_t matched = {0};
  for (const double end = now() + seconds; now() < end && matched.current_count == 0; dds_sleepfor(DDS_MSECS(20)))
    dds_get_publication_matched_status(writer, &matched);
  return matched.current_count > 0;
}

static int run_twist(const char* topic, double x, double z, double seconds) {
  const dds_entity_t writer = make_writer(topic, &geometry_msgs_msg_dds__Twist__desc);
  if (writer < 0) return fail(dds_strretcode(writer));
  geometry_msgs_msg_dds__Twist_ twist;
  memset(&twist, 0, sizeof twist);
  twist.linear.x = x;
  twist.angular.z = z;
  printf("ready\n");
  fflush(stdout);
  if (!wait_for_reader(writer, 60)) return fail("nobody reads it");
  for (const double end = now() + seconds; now() < end; dds_sleepfor(DDS_MSECS(100))) dds_write(writer, &twist);
  return 0;
}

static int run_writers(double seconds) {
  const dds_entity_t reader = dds_create_reader(g_participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, NULL, NULL);
  printf("ready\n");
  for (const double end = now() + seconds; now() < end; dds_sleepfor(DDS_MSECS(20))) {
    void* sample = NULL;
    dds_sample_info_t info;
    while (dds_take(reader, &sample, &info, 1, 1) == 1) {
      const dds_builtintopic_endpoint_t* const writer = sample;
      void* data = NULL;
      size_t size = 0;
      if (info.valid_data && writer->qos != NULL) dds_qget_userdata(writer->qos, &data, &size);
      if (info.valid_data) {
        printf("writer %s %s '%.*s' ", writer->topic_name, writer->type_name, (int)size, data == NULL ? "" : (char*)data);
        for (int i = 0; i < 16; ++i) printf("%02x", writer->key.v[i]);
        printf("\n");
      }
      dds_free(data);
      dds_return_loan(reader, &sample, 1);
      sample = NULL;
    }
    fflush(stdout);
  }
  return 0;
}

int main(int argc, char** argv) {
  const char* const domain = getenv("ROS_DOMAIN_ID");
  g_participant = dds_create_participant(domain == NULL ? 0 : (dds_domainid_t)atoi(domain), NULL, NULL);
  if (g_participant < 0) return fail(dds_strretcode(g_participant));
  setvbuf(stdout, NULL, _IOLBF, 0);
  int result = 2;
  if (argc == 6 && strcmp(argv[1], "read") == 0)
    result = run_read(argv[2], argv[3], argv[4], atof(argv[5]));
  else if (argc == 6 && strcmp(argv[1], "twist") == 0)
    result = run_twist(argv[2], atof(argv[3]), atof(argv[4]), atof(argv[5]));
  else if (argc == 3 && strcmp(argv[1], "writers") == 0)
    result = run_writers(atof(argv[2]));
  else
    fail("see its source for what it can");
  dds_delete(g_participant);
  return result;
}
